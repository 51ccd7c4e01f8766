# SPDX-License-Identifier: Apache-2.0
# The page of `spa report`. Its plots are drawn by Chart.js (MIT), which npm fetches in
# the version that npm/package-lock.json pins: sh tools/setup.sh build. Without it the verb is not built.
find_path(SPA_NODE_MODULES chart.js/dist/chart.umd.min.js PATHS ${PROJECT_SOURCE_DIR}/build/npm/node_modules
  NO_DEFAULT_PATH DOC "Folder node_modules that has chart.js, for the page of spa report")
if(SPA_NODE_MODULES AND NOT EXISTS ${SPA_NODE_MODULES}/chart.js/dist/chart.umd.min.js)
  message(FATAL_ERROR "SPA_NODE_MODULES is ${SPA_NODE_MODULES}, where chart.js/dist/chart.umd.min.js is not")
endif()
if(SPA_NODE_MODULES)
  set(SPA_CHART_JS ${SPA_NODE_MODULES}/chart.js/dist/chart.umd.min.js)
  set(chart_js_licenses ${SPA_NODE_MODULES}/chart.js/LICENSE.md ${SPA_NODE_MODULES}/@kurkle/color/LICENSE.md)
  spa_page(report
    STYLE base.css report.css
    SCRIPT text.js sorting.js report_table.js report_plot.js report_details.js report_plans.js report.js
    LIBRARY ${SPA_CHART_JS}
    LICENSES ${chart_js_licenses})
  install(FILES ${SPA_NODE_MODULES}/chart.js/LICENSE.md RENAME chart.js.txt
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/licenses COMPONENT tools)
  install(FILES ${SPA_NODE_MODULES}/@kurkle/color/LICENSE.md RENAME kurkle-color.txt
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/licenses COMPONENT tools)
else()
  message(STATUS "spa report is not built: chart.js is not in build/npm (sh tools/setup.sh build fetches it; "
    "SPA_NODE_MODULES names another place)")
endif()
