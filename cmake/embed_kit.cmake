# Writes OUTPUT, C++ that defines popup::flatlang::kit_table() with the texts of all *.fl files in FOLDER. Texts are
# arrays of characters, since the length of string literals is limited. Nothing but names and texts goes into it.
#   cmake -D FOLDER=dir -D OUTPUT=file.cpp -P embed_kit.cmake
file(GLOB names RELATIVE ${FOLDER} ${FOLDER}/*.fl)
list(SORT names COMPARE STRING CASE SENSITIVE)
list(LENGTH names count)

set(texts "")
set(rows "")
set(number 0)
foreach(name IN LISTS names)
  file(READ ${FOLDER}/${name} bytes HEX)
  string(LENGTH "${bytes}" length)
  math(EXPR length "${length} / 2")
  string(REGEX REPLACE "(................................)" "\\1\n    " bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  # An array has at least one element; that of an empty file is not counted.
  string(APPEND texts "const char text_${number}[] = {\n    ${bytes}'\\0'};\n")
  string(APPEND rows "    {\"${name}\", {text_${number}, ${length}}},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE ${OUTPUT} "// Written by embed_kit.cmake; changes are lost.
#include <array>

#include \"input/flatlang/kit_table.h\"

namespace popup::flatlang {
namespace {

${texts}
const std::array<KitFile, ${count}> files{{
${rows}}};

}  // namespace

std::span<const KitFile> kit_table() { return files; }

}  // namespace popup::flatlang
")
