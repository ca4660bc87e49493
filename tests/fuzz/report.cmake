# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_saved_diagnosis SOURCES saved_diagnosis.cpp ${CMAKE_SOURCE_DIR}/tests/report/gap_samples.cpp USES navcal::report)
