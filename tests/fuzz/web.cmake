# SPDX-License-Identifier: Apache-2.0
foreach(target control_admission foxglove_client http_query record_line signalk_client web_server)
  navcal_fuzz(fuzz_${target} SOURCES ${target}.cpp USES navcal::web nlohmann_json::nlohmann_json)
endforeach()
