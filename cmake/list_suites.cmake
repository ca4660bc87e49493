# SPDX-License-Identifier: Apache-2.0
# Run after a test program is linked: writes one ctest entry for each of its suites to OUTPUT. One for each test would start 3000
# processes, and a tenth of a second with sanitizers is spent on each start.
# PROGRAM, OUTPUT, PROPERTIES: the test program, the file, and the properties of its entries.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests TIMEOUT 60 OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
set(entries)
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  string(APPEND entries "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
    "set_tests_properties([=[${suite}]=] PROPERTIES ${PROPERTIES})\n")
endforeach()
file(WRITE ${OUTPUT} "${entries}")
