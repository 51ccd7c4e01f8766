# SPDX-License-Identifier: Apache-2.0
# Installs the component "development" of BUILD_DIR into a fresh PREFIX.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --component development --prefix ${PREFIX}
  COMMAND_ERROR_IS_FATAL ANY)
