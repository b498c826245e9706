# cmake --install, find_package(evigrid), pkg-config and Debian packages. Four parts: the shared libraries, what it takes
# to compile against them (headers, static libraries, CMake and pkg-config files), the command, the Python module.
include(CMakePackageConfigHelpers)
set(EVIGRID_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/evigrid)

# Static and shared in files of their own: only the static ones need the packages they were made of again.
set(static_targets evigrid_kernels evigrid_engine)
set(shared_targets "")
set(header_dirs engine/include/evigrid)
foreach(target evigrid_cuda evigrid_raycast)
  if(TARGET ${target})
    list(APPEND static_targets ${target})
  endif()
endforeach()
foreach(target evigrid_engine_shared evigrid_raycast_shared evigrid_c)
  if(TARGET ${target})
    list(APPEND shared_targets ${target})
  endif()
endforeach()
if(EVIGRID_BUILD_RAYCAST)
  list(APPEND header_dirs raycast/include/evigrid)
endif()

install(TARGETS ${static_targets} EXPORT evigrid-static ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(EXPORT evigrid-static NAMESPACE evigrid:: DESTINATION ${EVIGRID_CONFIG_DIR} COMPONENT dev)
if(shared_targets)
  install(TARGETS ${shared_targets} EXPORT evigrid-shared
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT dev)
  install(EXPORT evigrid-shared NAMESPACE evigrid:: DESTINATION ${EVIGRID_CONFIG_DIR} COMPONENT dev)
endif()
foreach(dir ${header_dirs})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${dir} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/evigrid-config.cmake.in
  ${PROJECT_BINARY_DIR}/evigrid-config.cmake INSTALL_DESTINATION ${EVIGRID_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/evigrid-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/evigrid-config.cmake ${PROJECT_BINARY_DIR}/evigrid-config-version.cmake
  ${PROJECT_SOURCE_DIR}/cmake/Findzstd.cmake DESTINATION ${EVIGRID_CONFIG_DIR} COMPONENT dev)

# pkg-config: evigrid (the C interface), evigrid_engine and evigrid_raycast (C++).
function(evigrid_pkg_config library description cflags private)
  set(PC_LIBRARY ${library})
  set(PC_DESCRIPTION ${description})
  set(PC_CFLAGS ${cflags})
  set(PC_PRIVATE ${private})
  file(RELATIVE_PATH PC_UP /${CMAKE_INSTALL_LIBDIR} /)  # the tree may be moved: paths from where the file lies
  configure_file(${PROJECT_SOURCE_DIR}/cmake/evigrid.pc.in ${PROJECT_BINARY_DIR}/${library}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${library}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()
evigrid_pkg_config(evigrid_engine "Evidential occupancy grids" "-std=c++20"
  "-levigrid_kernels -lhwy -ltbb -lzstd -fopenmp -lpthread")
if(TARGET evigrid_raycast)
  evigrid_pkg_config(evigrid_raycast "Sonar cones and lasers cast into flat worlds" "-std=c++20"
    "-lembree3 -lhwy -ltbb -lpthread")
endif()
if(TARGET evigrid_c)
  evigrid_pkg_config(evigrid "Evidential occupancy grids, C interface" "" "")
endif()

if(TARGET evigrid)
  install(TARGETS evigrid RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
endif()

# Debian packages: cpack -G DEB --config build/CPackConfig.cmake
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME evigrid)
set(CPACK_PACKAGE_VENDOR evigrid)
set(CPACK_PACKAGE_CONTACT "evigrid developers <evigrid@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "evidential occupancy grids from sonar and laser ranges")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENTS_ALL libraries dev command)
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libevigrid${abi})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libevigrid-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libevigrid${abi} (= ${PROJECT_VERSION}), libtbb-dev, libzstd-dev, libhwy-dev, libembree-dev")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME evigrid)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
if(TARGET evigrid_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-evigrid)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
endif()
include(CPack)
