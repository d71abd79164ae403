# The compiled part of the Python package (python/pelage), in build/.../python/pelage beside the rest of it, so that the
# folder can be imported from as it is.
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 2.10 REQUIRED)
file(GLOB module_sources CONFIGURE_DEPENDS python/module/*.cpp)
pybind11_add_module(pelage_python MODULE NO_EXTRAS ${module_sources})
set_target_properties(pelage_python PROPERTIES OUTPUT_NAME _core CXX_VISIBILITY_PRESET hidden
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/pelage)
target_compile_definitions(pelage_python PRIVATE PELAGE_VERSION="${PROJECT_VERSION}")
target_link_libraries(pelage_python PRIVATE pelage pelage_render pelage_flags)

file(GLOB python_files CONFIGURE_DEPENDS python/pelage/*.py python/pelage/*.pyi python/pelage/py.typed)
add_custom_target(pelage_python_package ALL
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${python_files} ${PROJECT_BINARY_DIR}/python/pelage)
add_dependencies(pelage_python_package pelage_python)
