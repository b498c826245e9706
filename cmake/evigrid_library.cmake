# A library that others link: compiled once, position independent and with hidden symbols, and made both a static and a
# shared library of the same objects. The build tree and our own programs use the static one, as `evigrid::NAME`.
#   evigrid_library(NAME engine SOURCES a.cpp ... LINK lib ...)
# gives evigrid_NAME (static), evigrid_NAME_shared, and evigrid_NAME_objects to set properties of.
function(evigrid_library)
  cmake_parse_arguments(L "" "NAME" "SOURCES;LINK" ${ARGN})
  set(static evigrid_${L_NAME})
  set(shared evigrid_${L_NAME}_shared)
  set(objects evigrid_${L_NAME}_objects)

  add_library(${objects} OBJECT ${L_SOURCES})
  evigrid_target(${objects})
  set_target_properties(${objects} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(${objects} PRIVATE include src)
  target_link_libraries(${objects} PRIVATE ${L_LINK})

  add_library(${static} STATIC $<TARGET_OBJECTS:${objects}>)
  set(libraries ${static})
  set_target_properties(${static} PROPERTIES EXPORT_NAME ${L_NAME}_static)
  if(EVIGRID_BUILD_SHARED)
    add_library(${shared} SHARED $<TARGET_OBJECTS:${objects}>)
    list(APPEND libraries ${shared})
    # While the major version is 0, every minor one may change the interface.
    set_target_properties(${shared} PROPERTIES OUTPUT_NAME evigrid_${L_NAME} EXPORT_NAME ${L_NAME}_shared
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_link_options(${shared} PRIVATE -Wl,--exclude-libs,ALL -Wl,-z,defs
      -Wl,--version-script,${PROJECT_SOURCE_DIR}/cmake/exports.map)
    set_property(TARGET ${shared} APPEND PROPERTY LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
  endif()
  foreach(library ${libraries})
    evigrid_target(${library})
    target_include_directories(${library} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${library} PRIVATE ${L_LINK})
  endforeach()
  add_library(evigrid::${L_NAME} ALIAS ${static})
endfunction()
