# SPDX-License-Identifier: Apache-2.0
# The table of subcommands from the declarations in cli/commands.h: a line there is a subcommand of the group above it, and
# nothing else has to know of it but its file. Each of listed_commands gets a manual page.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/commands.h)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/commands.h command_lines REGEX "^(// Group: |// Not listed|void add_[a-z_]+\\(CLI::App& app\\);)")
set(command_calls "")
set(listed_commands)
foreach(line ${command_lines})
  if(line MATCHES "^// Group: (.+)")
    set(group ${CMAKE_MATCH_1})
  elseif(line MATCHES "^// Not listed")
    set(group "")
  elseif(line MATCHES "add_([a-z_]+)")
    string(APPEND command_calls "  add_${CMAKE_MATCH_1}(parent);\n  parent.get_subcommands(nullptr).back()->group(\"${group}\");\n")
    if(group)
      list(APPEND listed_commands ${CMAKE_MATCH_1})
    endif()
  endif()
endforeach()
