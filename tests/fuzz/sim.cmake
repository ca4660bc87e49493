# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_effects SOURCES effects.cpp USES navcal::sim)
navcal_fuzz(fuzz_layout SOURCES layout.cpp USES navcal::sim)
navcal_fuzz(fuzz_outputs SOURCES actuator_outputs.cpp USES navcal::sim)
