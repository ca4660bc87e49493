# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_request_line SOURCES request_line.cpp USES navcal::daemon)
navcal_fuzz(fuzz_control_line SOURCES control_line.cpp USES navcal::daemon)
