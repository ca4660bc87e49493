navcal_fuzz(fuzz_effects SOURCES effects.cpp USES navcal::sim)
