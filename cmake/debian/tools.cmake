# Read by cpack before it packs anything. Without `file` it stops with a message that names no package; without
# dpkg-shlibdeps it goes on, and the packages depend on nothing.
if(CPACK_GENERATOR STREQUAL "DEB")
  foreach(tool file dpkg-shlibdeps)
    string(MAKE_C_IDENTIFIER "EVIGRID_${tool}" found)
    find_program(${found} ${tool})
    if(NOT ${found})
      message(FATAL_ERROR "${tool} is not installed: Debian packages need `file` and `dpkg-dev`")
    endif()
  endforeach()
endif()
