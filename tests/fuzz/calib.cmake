# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_suite SOURCES suite.cpp USES navcal::calib)
navcal_fuzz(fuzz_calibration_state SOURCES calibration_state.cpp USES navcal::calib)
