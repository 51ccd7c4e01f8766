# SPDX-License-Identifier: Apache-2.0
# spa_library(NAME source...): a static library spa_NAME with the alias spa::NAME and the project's
# compile options. -ffp-contract=off keeps results equal across compilers and instruction sets.
function(spa_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -ffp-contract=off
    $<$<BOOL:${SPA_WARNINGS_AS_ERRORS}>:-Werror>
    # GCC 12 sees an overlap in "literal" + std::string where there is none (GCC bug 105651).
    $<$<AND:$<BOOL:${SPA_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU>>:-Wno-restrict>)
endfunction()

function(spa_library name)
  add_library(spa_${name} STATIC ${ARGN})
  add_library(spa::${name} ALIAS spa_${name})
  set_target_properties(spa_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  spa_compile_options(spa_${name})
endfunction()
