# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_gps_stream SOURCES gps_stream.cpp USES navcal::protocols)
navcal_fuzz(fuzz_imu_card SOURCES imu_card.cpp USES navcal::protocols)
navcal_fuzz(fuzz_mip SOURCES mip.cpp USES navcal::protocols)
navcal_fuzz(fuzz_motor_card SOURCES motor_card.cpp USES navcal::protocols)
navcal_fuzz(fuzz_nmea SOURCES nmea.cpp USES navcal::protocols)
navcal_fuzz(fuzz_oncore SOURCES oncore.cpp USES navcal::protocols)
navcal_fuzz(fuzz_tcm2 SOURCES tcm2.cpp USES navcal::protocols)
navcal_fuzz(fuzz_ubx SOURCES ubx.cpp USES navcal::protocols)
