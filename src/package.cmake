# What 'cmake --install' and CPack put where: the program with its chips and scenes, and the layers as libraries for
# programs that say find_package(gnomon).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

# bin/gnomon finds profiles and scenes in share/gnomon beside bin.
install(TARGETS gnomon)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gnomon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/profiles ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon)
install(FILES ${PROJECT_SOURCE_DIR}/tests/expected/matrix.txt
        DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/tests/expected)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

# #include "method/method.h", target_link_libraries(... gnomon::method)
get_property(layers GLOBAL PROPERTY GNOMON_LAYERS)
list(REMOVE_ITEM layers app)
install(TARGETS ${layers} EXPORT gnomon ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/gnomon COMPONENT libraries)
foreach(layer IN LISTS layers)
    install(DIRECTORY ${layer} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon COMPONENT libraries
            FILES_MATCHING PATTERN "*.h" PATTERN web EXCLUDE)
endforeach()
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
install(EXPORT gnomon NAMESPACE gnomon:: FILE gnomonTargets.cmake DESTINATION ${config} COMPONENT libraries)
configure_package_config_file(gnomonConfig.cmake.in gnomonConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gnomonConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/gnomonConfigVersion.cmake
        DESTINATION ${config} COMPONENT libraries)

# cpack --config build/release/CPackConfig.cmake: the program as a .deb. What it is linked to is found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the maintainers of gnomon")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "says which shadow algorithm an old graphics chip can run, how exact, and at what cost")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gnomon)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri")  # --device egl loads them as it starts
include(CPack)
