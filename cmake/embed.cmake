# Writes OUTPUT, a C++ source with the text of FILES (paths relative to ROOT) as raw string literals.
set(text "// Made by cmake/embed.cmake from models/, recipes/, figures/ and others.\n#include \"catalog/embedded.h\"\n\nnamespace pelage {\n")
string(APPEND text "const std::vector<EmbeddedFile>& embedded_files() {\n  static const std::vector<EmbeddedFile> files = {\n")
foreach(name IN LISTS FILES)
  file(READ ${ROOT}/${name} content)
  string(APPEND text "    {\"${name}\", R\"~toml~(${content})~toml~\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n}  // namespace pelage\n")
file(WRITE ${OUTPUT} "${text}")
