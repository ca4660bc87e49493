navcal_fuzz(fuzz_bank_file SOURCES bank_file.cpp USES navcal::gap)
