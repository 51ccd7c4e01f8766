# SPDX-License-Identifier: Apache-2.0
# Shaders to SPIR-V at build time, checked by spirv-val.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
mark_as_advanced(GLSLANG_VALIDATOR SPIRV_VAL)

# spa_spirv(INPUT OUTPUT): GLSL, by the extension's stage, or an HLSL compute shader (.hlsl). The tracing text is on the
# include path.
function(spa_spirv input output)
  set(language -V)
  set(environment vulkan1.2)
  if(input MATCHES "[.]hlsl$")
    # Without glslang's optimiser, which reorders what the text orders.
    set(language -D -Od -S comp -e main)
    set(environment vulkan1.1)
  endif()
  cmake_path(GET output PARENT_PATH folder)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${GLSLANG_VALIDATOR} --quiet ${language} --target-env ${environment} -I${PROJECT_SOURCE_DIR}/shaders
      --depfile ${output}.d -o ${output} ${input}
    COMMAND ${SPIRV_VAL} --target-env ${environment} --scalar-block-layout ${output}
    DEPENDS ${input}
    DEPFILE ${output}.d
    VERBATIM)
endfunction()

# spa_embed_spirv(TARGET NAME INPUT): the SPIR-V of a shader as words in a header of TARGET's own,
# "spirv/INPUT's file name.h": constexpr std::uint32_t NAME[].
function(spa_embed_spirv target name input)
  cmake_path(GET input FILENAME file)
  set(spirv ${CMAKE_CURRENT_BINARY_DIR}/spirv/${file}.spv)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/spirv/${file}.h)
  spa_spirv(${input} ${spirv})
  add_custom_command(OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${spirv} -DOUTPUT=${header} -DNAME=${name}
      -P ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
    DEPENDS ${spirv} ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
