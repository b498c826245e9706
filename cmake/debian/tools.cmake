# Read by cpack before it packs anything: without these it would go on, and leave out dependencies or symbols in silence.
foreach(tool file dpkg-shlibdeps)
  string(MAKE_C_IDENTIFIER "EVIGRID_${tool}" found)
  find_program(${found} ${tool})
  if(NOT ${found})
    message(FATAL_ERROR "cpack: ${tool} is not installed; the Debian packages are `file` and `dpkg-dev`")
  endif()
endforeach()
