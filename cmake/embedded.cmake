# What pelage and pelage_look have inside of them beside code.

# models/*.toml, recipes, regions, patches, scenes and figures are compiled in, so that the program needs no data directory.
file(GLOB data_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  ${PROJECT_SOURCE_DIR}/models/*.toml ${PROJECT_SOURCE_DIR}/recipes/*.toml ${PROJECT_SOURCE_DIR}/regions/*.toml
  ${PROJECT_SOURCE_DIR}/patches/*.toml ${PROJECT_SOURCE_DIR}/scenes/*.toml
  ${PROJECT_SOURCE_DIR}/figures/*.toml)
set(embedded_cpp ${PROJECT_BINARY_DIR}/embedded_data.cpp)
list(TRANSFORM data_files PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE data_paths)
add_custom_command(OUTPUT ${embedded_cpp}
  COMMAND ${CMAKE_COMMAND} "-DFILES=${data_files}" -DROOT=${PROJECT_SOURCE_DIR} -DOUTPUT=${embedded_cpp}
    -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  DEPENDS ${data_paths} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)

# The font of labels in pictures is compiled in as well.
find_file(DEJAVU_SANS DejaVuSans.ttf PATHS /usr/share/fonts PATH_SUFFIXES truetype/dejavu dejavu TTF dejavu-sans-fonts REQUIRED
  NO_CMAKE_FIND_ROOT_PATH)
set(font_cpp ${PROJECT_BINARY_DIR}/embedded_font.cpp)
add_custom_command(OUTPUT ${font_cpp}
  COMMAND ${CMAKE_COMMAND} -DINPUT=${DEJAVU_SANS} -DNAME=DejaVuSans.ttf -DOUTPUT=${font_cpp}
    -P ${PROJECT_SOURCE_DIR}/cmake/embed_font.cmake
  DEPENDS ${DEJAVU_SANS} ${PROJECT_SOURCE_DIR}/cmake/embed_font.cmake VERBATIM)

target_sources(pelage PRIVATE ${embedded_cpp})
target_sources(pelage_look PRIVATE ${font_cpp})
