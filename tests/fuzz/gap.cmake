# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_bank_file SOURCES bank_file.cpp ${CMAKE_SOURCE_DIR}/tests/gap/nulls/made_up_bank.cpp USES navcal::gap)
navcal_fuzz(fuzz_watch_line SOURCES watch_line.cpp USES navcal::gap)
navcal_fuzz(fuzz_watch_state SOURCES watch_state.cpp USES navcal::gap)
