# SPDX-License-Identifier: Apache-2.0
# The table of subcommands from the declarations in cli/commands.h: a line there is a subcommand, and nothing else has to
# know of it but its file.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/commands.h)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commands.h command_lines REGEX "^void add_[a-z_]+\\(CLI::App& app\\);")
set(command_calls "")
foreach(line ${command_lines})
  string(REGEX MATCH "add_[a-z_]+" function "${line}")
  string(APPEND command_calls "  ${function}(parent);\n")
endforeach()
set(command_table ${CMAKE_CURRENT_BINARY_DIR}/command_table.cpp)
configure_file(${CMAKE_CURRENT_LIST_DIR}/command_table.cpp.in ${command_table} @ONLY)
