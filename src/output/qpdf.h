// qpdf, for all that includes it.
#pragma once

// What its headers ask to be told: that its old smart pointer is not used here.
#define POINTERHOLDER_TRANSITION 4

// clang, up to 16 at least, cannot compile its JSON.hh with the standard library of g++ 12 in C++20: a
// destructor there, which is constexpr, asks for the size of a class that is not complete yet. Only the name
// is needed here.
#ifdef __clang__
#define JSON_HH
class JSON;
#endif

#include <qpdf/Buffer.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <qpdf/QPDFWriter.hh>
