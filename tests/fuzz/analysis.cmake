# SPDX-License-Identifier: Apache-2.0
navcal_fuzz(fuzz_import_csv SOURCES import_csv.cpp USES navcal::analysis)
navcal_fuzz(fuzz_import_dataflash SOURCES import_dataflash.cpp USES navcal::analysis)
navcal_fuzz(fuzz_import_mavlink_log SOURCES import_mavlink_log.cpp USES navcal::analysis)
navcal_fuzz(fuzz_import_ros_bag SOURCES import_ros_bag.cpp USES navcal::analysis)
navcal_fuzz(fuzz_import_slocum SOURCES import_slocum.cpp USES navcal::analysis)
navcal_fuzz(fuzz_import_ulog SOURCES import_ulog.cpp USES navcal::analysis)
