# The install tree: public headers, the libraries, and a package for find_package(pelage).

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pelage)
file(GLOB public_headers CONFIGURE_DEPENDS include/pelage/*.h)
install(FILES ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pelage)

set(libraries pelage_core)
if(TARGET pelage)
  list(APPEND libraries pelage_io pelage_look pelage)
endif()
install(TARGETS ${libraries} EXPORT pelageTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT pelageTargets NAMESPACE pelage:: DESTINATION ${package_dir})
if(TARGET pelage_render)  # by itself, so that others need no Embree
  install(TARGETS pelage_render EXPORT pelageRenderTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT pelageRenderTargets NAMESPACE pelage:: DESTINATION ${package_dir})
endif()

configure_package_config_file(cmake/pelageConfig.cmake.in ${PROJECT_BINARY_DIR}/pelageConfig.cmake
  INSTALL_DESTINATION ${package_dir})
# Below 1.0 every minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pelageConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pelageConfig.cmake ${PROJECT_BINARY_DIR}/pelageConfigVersion.cmake
  DESTINATION ${package_dir})

# The page of the studio, where tools/studio.sh has built it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/pelage/studio DESTINATION ${CMAKE_INSTALL_DATADIR}/pelage OPTIONAL)
