# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_run SOURCES run.cpp USES navcal::runs)
