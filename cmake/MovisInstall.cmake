# The install tree: headers and targets for find_package(movis), the program, the data.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY MOVIS_MODULES)
install(TARGETS ${modules} EXPORT movisTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS movis_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/movis/data)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/movis)
install(EXPORT movisTargets NAMESPACE movis:: DESTINATION ${package_dir})
configure_package_config_file(cmake/movisConfig.cmake.in ${PROJECT_BINARY_DIR}/movisConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/movisConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/movisConfig.cmake ${PROJECT_BINARY_DIR}/movisConfigVersion.cmake
              cmake/MovisDependencies.cmake
        DESTINATION ${package_dir})
