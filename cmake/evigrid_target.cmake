# What every target of ours shares: C++20, baseline x86-64 (no -march), no contraction of a*b+c into fma (equal bits),
# warnings private to us, sanitizers from one option; with EVIGRID_FUZZ the counters libFuzzer steers by, in every library
# but the kernels: they read no files, and their tables take a quarter of an hour each to compile with all checks.
find_package(Threads REQUIRED)

# evigrid_target(target [17]): 17 only where other people's headers ask for it.
function(evigrid_target target)
  if("${ARGN}" STREQUAL "17")
    target_compile_features(${target} PRIVATE cxx_std_17)
    set_target_properties(${target} PROPERTIES CXX_STANDARD 17)
  else()
    target_compile_features(${target} PUBLIC cxx_std_20)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi
    $<$<BOOL:${EVIGRID_WERROR}>:-Werror>)
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(EVIGRID_FUZZ AND target STREQUAL "evigrid_kernels")
    return()
  endif()
  if(EVIGRID_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${EVIGRID_SANITIZE} -fno-omit-frame-pointer
      -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${EVIGRID_SANITIZE})
  endif()
  if(EVIGRID_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()
