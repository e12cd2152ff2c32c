# Writes OUTPUT, C++ that defines SPACE::TABLE() with the texts of all files in FOLDER whose names end in one of ENDS.
# HEADER declares the function, and the struct FILE of a name and a text that its rows are. Texts are arrays of
# characters, since the length of string literals is limited. Nothing but names and texts goes into it.
#   cmake -D FOLDER=dir -D "ENDS=.fl" -D HEADER=input/flatlang/kit_table.h -D SPACE=popup::flatlang -D FILE=KitFile
#         -D TABLE=kit_table -D OUTPUT=file.cpp -P embed_files.cmake
set(names "")
foreach(end IN LISTS ENDS)
  file(GLOB found RELATIVE ${FOLDER} ${FOLDER}/*${end})
  list(APPEND names ${found})
endforeach()
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

file(WRITE ${OUTPUT} "// Written by embed_files.cmake; changes are lost.
#include <array>

#include \"${HEADER}\"

namespace ${SPACE} {
namespace {

${texts}
const std::array<${FILE}, ${count}> files{{
${rows}}};

}  // namespace

std::span<const ${FILE}> ${TABLE}() { return files; }

}  // namespace ${SPACE}
")
