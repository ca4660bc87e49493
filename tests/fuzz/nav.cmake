# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_navigator SOURCES navigator.cpp USES navcal::nav)
