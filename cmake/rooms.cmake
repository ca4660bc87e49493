# SPDX-License-Identifier: Apache-2.0
# Which room (folder) may include which: the only table. Links and include folders follow it (navcal_room), the test
# tests/rooms compares it with every #include, and the table of ARCHITECTURE.md is compared with it. In the order in which
# the rooms may use each other; each line names all rooms that are included directly. A folder within a room can be a room of
# its own (validation/reference); the room around it then does not contain it.
set(NAVCAL_ROOMS base protocols config devices control instruments calib nav pipeline record ports link autopilot sim gap analysis validation/reference validation report api share web daemon cli)
set(NAVCAL_MAY_INCLUDE_base)
set(NAVCAL_MAY_INCLUDE_protocols)
set(NAVCAL_MAY_INCLUDE_config base protocols)
set(NAVCAL_MAY_INCLUDE_devices base protocols config)
set(NAVCAL_MAY_INCLUDE_control protocols config)
set(NAVCAL_MAY_INCLUDE_instruments base protocols config)
set(NAVCAL_MAY_INCLUDE_calib base)
set(NAVCAL_MAY_INCLUDE_nav base)
set(NAVCAL_MAY_INCLUDE_pipeline base protocols config devices instruments calib nav)
set(NAVCAL_MAY_INCLUDE_record base protocols config control instruments calib pipeline)
set(NAVCAL_MAY_INCLUDE_ports base protocols config)
set(NAVCAL_MAY_INCLUDE_link protocols)
set(NAVCAL_MAY_INCLUDE_autopilot base config)
set(NAVCAL_MAY_INCLUDE_sim base protocols config devices autopilot)
set(NAVCAL_MAY_INCLUDE_gap base protocols config devices instruments calib pipeline record autopilot sim)
set(NAVCAL_MAY_INCLUDE_analysis base protocols config devices instruments calib pipeline record ports sim)
set(NAVCAL_MAY_INCLUDE_validation/reference protocols)
set(NAVCAL_MAY_INCLUDE_validation base config record sim analysis validation/reference)
set(NAVCAL_MAY_INCLUDE_report base config devices calib pipeline record sim gap analysis validation)
set(NAVCAL_MAY_INCLUDE_api protocols config devices instruments pipeline record sim gap analysis report)
set(NAVCAL_MAY_INCLUDE_share)
set(NAVCAL_MAY_INCLUDE_web base record ports share)
set(NAVCAL_MAY_INCLUDE_daemon base protocols config control instruments pipeline record ports link share)
set(NAVCAL_MAY_INCLUDE_cli base protocols config devices record ports link autopilot sim gap analysis validation report share web)

# The order of the folders within a room: each may include itself, those before it, and what lies in the room's own folder.
# What lies there may include all of them only from a .cpp. Folders that are not named (calib/thesis) are free.
set(NAVCAL_ORDER_calib turn magnetometer gps delay swing reference suite)
set(NAVCAL_ORDER_gap data actuators replay inference nulls verdict)

# The rooms of the shared library: api and all that it uses, directly or not. Their code is independent of its position and
# their symbols are hidden; api marks those that are exported.
set(NAVCAL_LIBRARY_ROOMS api)
set(rooms_from_the_last ${NAVCAL_ROOMS})
list(REVERSE rooms_from_the_last)
foreach(room IN LISTS rooms_from_the_last)
  if(room IN_LIST NAVCAL_LIBRARY_ROOMS)
    list(APPEND NAVCAL_LIBRARY_ROOMS ${NAVCAL_MAY_INCLUDE_${room}})
  endif()
endforeach()
list(REMOVE_DUPLICATES NAVCAL_LIBRARY_ROOMS)

# navcal_include_rooms(TARGET ROOM): gives a target the headers of a room, and of what that room may include with what their
# headers include in turn. No others: a folder of links in the build folder is the target's only include folder of ours.
function(navcal_include_rooms target room)
  string(REPLACE / _ folder ${room})
  set(folder ${CMAKE_BINARY_DIR}/rooms/${folder})
  set(todo ${room})
  set(done)
  while(todo)
    list(POP_FRONT todo next)
    if(NOT next IN_LIST NAVCAL_ROOMS)
      message(FATAL_ERROR "cmake/rooms.cmake does not know the room ${next}")
    endif()
    if(next IN_LIST done)
      continue()
    endif()
    list(APPEND done ${next})
    list(APPEND todo ${NAVCAL_MAY_INCLUDE_${next}})
    if(NOT EXISTS ${folder}/${next})
      cmake_path(GET next PARENT_PATH parent)
      file(MAKE_DIRECTORY ${folder}/${parent})
      file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${next} ${folder}/${next} SYMBOLIC)
    endif()
  endwhile()
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
