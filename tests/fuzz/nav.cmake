navcal_fuzz(fuzz_navigator SOURCES navigator.cpp USES navcal::nav)
