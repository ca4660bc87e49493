navcal_fuzz(fuzz_toml SOURCES toml.cpp USES navcal::config)
