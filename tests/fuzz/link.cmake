# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_link SOURCES link.cpp USES navcal::link)
