# SPDX-License-Identifier: Apache-2.0
# cmake -DPAGE=FILE.md -DLANGUAGE=NAME -DOUTPUT=FILE -P page_snippet.cmake
# Writes the one block of a page that is fenced as this language.
file(READ ${PAGE} text)
set(fence "\n```${LANGUAGE}\n")
string(FIND "${text}" "${fence}" begin)
if(begin EQUAL -1)
  message(FATAL_ERROR "${PAGE} has no block of ${LANGUAGE}")
endif()
string(LENGTH "${fence}" length)
math(EXPR begin "${begin} + ${length}")
string(SUBSTRING "${text}" ${begin} -1 text)
string(FIND "${text}" "${fence}" again)
if(NOT again EQUAL -1)
  message(FATAL_ERROR "${PAGE} has several blocks of ${LANGUAGE}")
endif()
string(FIND "${text}" "\n```" end)
string(SUBSTRING "${text}" 0 ${end} text)
file(WRITE ${OUTPUT} "${text}\n")
