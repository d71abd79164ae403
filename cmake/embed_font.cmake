# Writes OUTPUT, a C++ source with the bytes of the font INPUT as string literals.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
string(LENGTH "${bytes}" length)
math(EXPR size "${length} / 4")
file(WRITE ${OUTPUT} "// Made by cmake/embed_font.cmake from ${NAME}.\n#include \"look/font.h\"\n\nnamespace pelage {\n"
  "std::string_view font_file() { return {\"${bytes}\", ${size}}; }\n}  // namespace pelage\n")
