# SPDX-License-Identifier: Apache-2.0
# cmake -DINPUT=FILE -DFOLDER=FOLDER -DOUTPUT=FILE -P inline_includes.cmake
# Puts the files of FOLDER in place of the lines #include "FILE", as whoever hands the text to a language without
# #include has to. A file comes as often as it is asked for: include guards are the preprocessor's.
file(READ ${INPUT} text)
while(text MATCHES "\n#include \"([^\"]+)\"")
  set(directive "${CMAKE_MATCH_0}")
  file(READ ${FOLDER}/${CMAKE_MATCH_1} included)
  string(REPLACE "${directive}" "\n${included}" text "${text}")
endwhile()
file(WRITE ${OUTPUT} "${text}")
