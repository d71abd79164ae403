# The full program: threads, files, pictures, command line, tests.

find_package(TBB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(pugixml REQUIRED)
find_package(embree 3 REQUIRED)
find_path(STB_INCLUDE_DIR stb_truetype.h PATH_SUFFIXES stb REQUIRED)
find_path(SPNG_INCLUDE_DIR spng.h REQUIRED)
find_library(SPNG_LIBRARY spng REQUIRED)
find_path(TURBOJPEG_INCLUDE_DIR turbojpeg.h REQUIRED)
find_library(TURBOJPEG_LIBRARY turbojpeg REQUIRED)
find_path(LIBDEFLATE_INCLUDE_DIR libdeflate.h REQUIRED)
find_library(LIBDEFLATE_LIBRARY deflate REQUIRED)
find_path(LIBMD_INCLUDE_DIR sha2.h REQUIRED)
find_library(LIBMD_LIBRARY md REQUIRED)
find_path(HTTPLIB_INCLUDE_DIR httplib.h REQUIRED)
find_library(HTTPLIB_LIBRARY cpp-httplib REQUIRED)
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
find_library(TINYGLTF_LIBRARY tinygltf REQUIRED)
option(PELAGE_DRACO "Read glTF that Draco compressed, where its library is found" ON)
option(PELAGE_MESHOPTIMIZER "Read and write glTF that meshoptimizer compresses, where its library is found" ON)
if(PELAGE_DRACO)
  find_package(draco QUIET CONFIG)
endif()
if(PELAGE_MESHOPTIMIZER)
  find_package(meshoptimizer QUIET CONFIG)
endif()

# --- the libraries, from left to right in the line of layers (docs/architecture.md) ----------------------
# Threads: base/parallel.cpp is all that differs from the core alone.
set_source_files_properties(src/base/parallel.cpp PROPERTIES COMPILE_DEFINITIONS PELAGE_HAS_TBB)
target_link_libraries(pelage_core PRIVATE TBB::tbb)
if(PELAGE_SANITIZE MATCHES thread)
  # TBB's library is not instrumented, so its headers must not be, either; parallel.cpp says in which order things happen.
  set_property(SOURCE src/base/parallel.cpp APPEND PROPERTY COMPILE_DEFINITIONS PELAGE_TSAN)
  set_source_files_properties(src/base/parallel.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread
    SKIP_PRECOMPILE_HEADERS ON)
endif()

pelage_library(pelage_io io recipe)  # files and texts
target_include_directories(pelage_io SYSTEM PRIVATE ${TINYGLTF_INCLUDE_DIR} ${LIBDEFLATE_INCLUDE_DIR} ${SPNG_INCLUDE_DIR}
  ${TURBOJPEG_INCLUDE_DIR} ${LIBMD_INCLUDE_DIR})
target_link_libraries(pelage_io PUBLIC pelage_core PRIVATE tomlplusplus::tomlplusplus
  $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>  # a header of tinygltf
  $<BUILD_INTERFACE:${TINYGLTF_LIBRARY}> $<INSTALL_INTERFACE:tinygltf>
  $<BUILD_INTERFACE:${LIBDEFLATE_LIBRARY}> $<INSTALL_INTERFACE:deflate>
  $<BUILD_INTERFACE:${LIBMD_LIBRARY}> $<INSTALL_INTERFACE:md>
  $<BUILD_INTERFACE:${SPNG_LIBRARY}> $<INSTALL_INTERFACE:spng>
  $<BUILD_INTERFACE:${TURBOJPEG_LIBRARY}> $<INSTALL_INTERFACE:turbojpeg>
  $<BUILD_INTERFACE:pugixml::pugixml> $<INSTALL_INTERFACE:pugixml>)
foreach(packer draco meshoptimizer)  # optional: without them compressed files are refused by name
  if(TARGET ${packer}::${packer})
    string(TOUPPER PELAGE_HAS_${packer} found)
    set_property(SOURCE src/io/gltf_${packer}.cpp src/io/gltf_compressor.cpp APPEND PROPERTY COMPILE_DEFINITIONS ${found})
    target_link_libraries(pelage_io PRIVATE $<BUILD_INTERFACE:${packer}::${packer}> $<INSTALL_INTERFACE:${packer}>)
  endif()
endforeach()

pelage_library(pelage_look print look)  # surfaces to be printed, colours, plots, lettering
target_include_directories(pelage_look SYSTEM PRIVATE ${STB_INCLUDE_DIR})
target_link_libraries(pelage_look PUBLIC pelage_core)

pelage_library(pelage gridgen solid measure unwrap catalog verify)  # grids for regions; volumes; patterns in numbers; atlases; from names to components; the interface of include/pelage
target_link_libraries(pelage PUBLIC pelage_look pelage_io)

pelage_library(pelage_studio studio)  # the engine behind the studio's page
target_compile_definitions(pelage_studio PRIVATE PELAGE_VERSION="${PROJECT_VERSION}")
target_link_libraries(pelage_studio PUBLIC pelage $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)

pelage_library(pelage_render render)  # pictures of surfaces
target_link_libraries(pelage_render PUBLIC pelage_core PRIVATE embree)

include(cmake/embedded.cmake)

# --- the command line -----------------------------------------------------------------------------------
file(GLOB cli_sources CONFIGURE_DEPENDS apps/cli/*.cpp)
list(REMOVE_ITEM cli_sources ${PROJECT_SOURCE_DIR}/apps/cli/main.cpp)
if(cli_sources)
  # All but main(), which the test of random command lines (tests/fuzz) uses, too.
  add_library(pelage_commands OBJECT ${cli_sources})
  # CLI11 and nlohmann-json cost a compiler ten seconds in every source that includes them; hence several sources at once.
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    set_target_properties(pelage_commands PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 9)
  endif()
  target_include_directories(pelage_commands PUBLIC src apps/cli)
  target_include_directories(pelage_commands SYSTEM PRIVATE ${HTTPLIB_INCLUDE_DIR})
  target_compile_definitions(pelage_commands PUBLIC PELAGE_VERSION="${PROJECT_VERSION}")
  target_link_libraries(pelage_commands PUBLIC pelage pelage_render pelage_studio ${HTTPLIB_LIBRARY} CLI11::CLI11 nlohmann_json::nlohmann_json Eigen3::Eigen pelage_flags)
  add_executable(pelage_cli apps/cli/main.cpp)
  set_target_properties(pelage_cli PROPERTIES OUTPUT_NAME pelage)
  target_link_libraries(pelage_cli PRIVATE pelage_commands)
  install(TARGETS pelage_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

option(PELAGE_PYTHON "Build the module of the Python package, where pybind11 is found" OFF)
if(PELAGE_PYTHON)
  include(cmake/python.cmake)
endif()

if(PELAGE_TESTS)
  enable_testing()
  add_subdirectory(tests)
  add_subdirectory(examples)
endif()
if(PELAGE_TESTS OR PELAGE_BENCHMARKS)
  add_subdirectory(bench)
endif()
