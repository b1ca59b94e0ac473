# SPDX-License-Identifier: MIT
# sherd_target(<target>): the compile settings every Sherd target shares.
# Floating point is kept to IEEE (no contraction) so that results are the same bits in every build type.
function(sherd_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden
                                             VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wnon-virtual-dtor)
  if(NOT CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -Wshadow)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Beside other files a local may have the name of what is global in one of those.
    target_compile_options(${target} PRIVATE -Wshadow=local)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 drops the rounding of double -> float -> double when it vectorises straight-line code (seen
    # at -O2 on two or more components), so that a point tested as a float is not the float stored.
    target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 reports `"text" + std::string` as overlapping memcpy (GCC bug 105329).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(SHERD_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# sherd_in_parts(<target>): a library of which the linker leaves out what nobody calls, function by function.
function(sherd_in_parts target)
  target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections)
endfunction()

# sherd_pkg(<NAME> <pkg-config module>): an imported target PkgConfig::<NAME> with system includes.
find_package(PkgConfig REQUIRED)
macro(sherd_pkg name module)
  if(NOT TARGET PkgConfig::${name})
    pkg_check_modules(${name} REQUIRED IMPORTED_TARGET GLOBAL ${module})
  endif()
endmacro()
