# Headers, library, program with its man page and completions, the add-on for Blender, scenes and their schema, documents, and the package files
# for find_package(pliant).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(PLIANT_SCENES_INSTALL_DIR "${CMAKE_INSTALL_DATADIR}/pliant/scenes")
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pliant")

set(header_folders "${PROJECT_SOURCE_DIR}/src/pliant" "${PROJECT_BINARY_DIR}/generated/pliant")
install(TARGETS pliant EXPORT pliantTargets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT pliantTargets NAMESPACE pliant:: DESTINATION "${package_dir}")
if(PLIANT_BUILD_IO)
  list(APPEND header_folders "${PROJECT_SOURCE_DIR}/src/pliant_io")
  install(TARGETS pliant_io EXPORT pliantIoTargets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT pliantIoTargets NAMESPACE pliant:: DESTINATION "${package_dir}")
endif()
if(PLIANT_BUILD_VIEWER)
  install(TARGETS pliant_viewer pliant_plot pliant_sweep pliant_report pliant_render pliant_system
    EXPORT pliantViewerTargets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT pliantViewerTargets NAMESPACE pliant:: DESTINATION "${package_dir}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/apps/viewer/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
endif()
if(PLIANT_BUILD_CLI)
  install(TARGETS pliant_cli)
  set(manual_dir "${PROJECT_BINARY_DIR}/generated/manual")  # see apps/cli
  install(FILES "${manual_dir}/pliant.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${manual_dir}/pliant.bash"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME pliant)
  install(FILES "${manual_dir}/_pliant" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${manual_dir}/pliant.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
  install(FILES "${PLIANT_BLENDER_ADDON}" DESTINATION "${CMAKE_INSTALL_DATADIR}/pliant")
endif()
install(DIRECTORY ${header_folders}
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h" PATTERN "detail" EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes/" DESTINATION "${PLIANT_SCENES_INSTALL_DIR}")
install(FILES "${PROJECT_SOURCE_DIR}/docs/scene.schema.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/pliant")
install(FILES
  "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

set(PLIANT_FIND_DEPENDENCIES "")
foreach(package IN LISTS pliant_library_packages)
  string(APPEND PLIANT_FIND_DEPENDENCIES "find_dependency(${package})\n")
endforeach()
set(PLIANT_FIND_IO_PACKAGES "")
set(PLIANT_IO_PACKAGES_FOUND "TRUE")
foreach(package IN LISTS pliant_io_packages)
  string(APPEND PLIANT_FIND_IO_PACKAGES "find_package(${package} QUIET)\n")
  string(REGEX REPLACE " .*" "" name "${package}")
  string(APPEND PLIANT_IO_PACKAGES_FOUND " AND ${name}_FOUND")
endforeach()
set(PLIANT_FIND_VIEWER_PACKAGES "")
set(PLIANT_VIEWER_PACKAGES_FOUND "PkgConfig_FOUND")
foreach(package IN LISTS pliant_viewer_packages)
  string(APPEND PLIANT_FIND_VIEWER_PACKAGES "find_package(${package} QUIET)\n  ")
  string(REGEX REPLACE " .*" "" name "${package}")
  string(APPEND PLIANT_VIEWER_PACKAGES_FOUND " AND ${name}_FOUND")
endforeach()
set(PLIANT_FIND_VIEWER_MODULES "")
foreach(module IN LISTS pliant_viewer_modules)
  string(REGEX REPLACE ">=.*" "" name "${module}")
  string(TOUPPER "${name}" name)
  string(APPEND PLIANT_FIND_VIEWER_MODULES "pkg_check_modules(${name} QUIET IMPORTED_TARGET \"${module}\")\n    ")
  string(APPEND PLIANT_VIEWER_PACKAGES_FOUND " AND ${name}_FOUND")
endforeach()
configure_package_config_file(cmake/pliantConfig.cmake.in "${PROJECT_BINARY_DIR}/pliantConfig.cmake"
  INSTALL_DESTINATION "${package_dir}" PATH_VARS PLIANT_SCENES_INSTALL_DIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/pliantConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/pliantConfig.cmake" "${PROJECT_BINARY_DIR}/pliantConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake"
  DESTINATION "${package_dir}")
