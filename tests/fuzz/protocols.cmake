navcal_fuzz(fuzz_gps_stream SOURCES gps_stream.cpp USES navcal::protocols)
navcal_fuzz(fuzz_nmea SOURCES nmea.cpp USES navcal::protocols)
navcal_fuzz(fuzz_oncore SOURCES oncore.cpp USES navcal::protocols)
