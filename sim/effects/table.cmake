# SPDX-License-Identifier: Apache-2.0
# The table of effects from the files of sim/effects/library: a file there is an effect, and nothing else has to know of it.
file(GLOB effect_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/library/*.cpp)
list(SORT effect_sources)
set(effect_makers "")
set(effect_entries "")
foreach(source ${effect_sources})
  get_filename_component(name ${source} NAME_WE)
  string(APPEND effect_makers "std::unique_ptr<Effect> make_${name}();\n")
  string(APPEND effect_entries "    {\"${name}\", &make_${name}},\n")
endforeach()
set(effect_table ${CMAKE_CURRENT_BINARY_DIR}/effect_table.cpp)
configure_file(${CMAKE_CURRENT_LIST_DIR}/effect_table.cpp.in ${effect_table} @ONLY)
