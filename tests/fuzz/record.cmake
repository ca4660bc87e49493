# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_capture SOURCES capture.cpp USES navcal::record)
navcal_fuzz(fuzz_mcap SOURCES mcap.cpp USES navcal::record)
