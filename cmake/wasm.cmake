# The library as WebAssembly, by Debian's emscripten: the preset "wasm", tools/wasm.sh. Libraries that exist for this
# machine alone are replaced by such that are headers (cmake/wasm/), or what they do is refused by name (Draco,
# meshoptimizer); Embree's pictures are left to the page.

# Headers of others stand between those of this machine's own C library, which must not be seen: links to just these.
set(wasm_include ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${wasm_include})
foreach(name range concepts meta std fast_float  # cmake/wasm/standard.h
        tiny_gltf.h nlohmann toml++)
  if(NOT EXISTS /usr/include/${name})
    message(FATAL_ERROR "/usr/include/${name} is missing; sh tools/wasm.sh installs what this build needs")
  endif()
  file(CREATE_LINK /usr/include/${name} ${wasm_include}/${name} SYMBOLIC)
endforeach()

# What GCC and a 64-bit machine see is not said again: numbers of 64 bits index memory of 32, which holds what there is.
target_compile_options(pelage_flags INTERFACE -fexceptions
  -Wno-unknown-warning-option -Wno-shorten-64-to-32 -Wno-unused-const-variable -Wno-unused-private-field)

target_include_directories(pelage_core SYSTEM PUBLIC ${wasm_include})
target_precompile_headers(pelage_core PRIVATE ${PROJECT_SOURCE_DIR}/cmake/wasm/standard.h)
target_sources(pelage_core PRIVATE cmake/wasm/standard.cpp)
# Inner loops that are written for registers of several numbers (base/each_instruction_set.h): four floats at a time, the
# same bits in half the time.
set_source_files_properties(src/react/kinetics.cpp src/react/tape.cpp src/react/tape_kernels.cpp src/time/fourier.cpp
  src/time/paired_nodes.cpp src/time/rkc2.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON
  COMPILE_OPTIONS "-msimd128;-include;${PROJECT_SOURCE_DIR}/cmake/wasm/standard.h")

# Files and texts: nobody asks here for records and journals, and XML is read by no library that is headers alone.
pelage_library(pelage_io io recipe)
get_target_property(sources pelage_io SOURCES)
list(FILTER sources EXCLUDE REGEX
  "src/io/(zlib|png_reader|jpeg_reader|sha256|journal|record_in_file|vtk_document|vtk_attributes|vtk_grid_reader|vtp_reader|vtu_reader)\\.cpp$")
set_property(TARGET pelage_io PROPERTY SOURCES ${sources})
target_sources(pelage_io PRIVATE
  cmake/wasm/zlib.cpp cmake/wasm/image_readers.cpp cmake/wasm/left_out.cpp cmake/wasm/tiny_gltf.cpp)
target_include_directories(pelage_io SYSTEM PRIVATE /usr/include/stb)
target_compile_definitions(pelage_io PRIVATE TOML_HEADER_ONLY=1
  TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE TINYGLTF_NO_EXTERNAL_IMAGE TINYGLTF_NO_INCLUDE_STB_IMAGE
  TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE)
target_link_libraries(pelage_io PUBLIC pelage_core)

pelage_library(pelage_look print look)
target_include_directories(pelage_look SYSTEM PRIVATE /usr/include/stb)
target_link_libraries(pelage_look PUBLIC pelage_core)

pelage_library(pelage gridgen solid measure unwrap catalog)
target_link_libraries(pelage PUBLIC pelage_look pelage_io)
include(cmake/embedded.cmake)
set_source_files_properties(${font_cpp} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)

pelage_library(pelage_studio studio)
target_compile_definitions(pelage_studio PRIVATE PELAGE_VERSION="${PROJECT_VERSION}")
target_link_libraries(pelage_studio PUBLIC pelage)

# One script that makes the module, and the module beside it; the page's worker loads them (studio/engine-worker.js).
function(wasm_program name output)
  add_executable(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES OUTPUT_NAME ${output}
    RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")  # Debian's acorn, also for another node
  target_precompile_headers(${name} REUSE_FROM pelage_core)
  target_include_directories(${name} PRIVATE src)
  target_link_libraries(${name} PRIVATE pelage_studio pelage_flags Eigen3::Eigen)
  target_link_options(${name} PRIVATE -fexceptions -sMODULARIZE=1 -sENVIRONMENT=worker,node -sALLOW_MEMORY_GROWTH=1
    -sMAXIMUM_MEMORY=4GB -msimd128)
endfunction()

wasm_program(pelage_wasm pelage-engine apps/studio/wasm.cpp)
target_link_options(pelage_wasm PRIVATE --no-entry -sEXPORT_NAME=createPelageEngine)
configure_file(studio/engine-worker.js ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/engine-worker.js COPYONLY)

wasm_program(wasm_cases wasm-cases cmake/wasm/cases.cpp)  # tests/wasm/compare.mjs
target_link_options(wasm_cases PRIVATE -sEXPORT_NAME=createCases)
