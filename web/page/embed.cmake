# SPDX-License-Identifier: Apache-2.0
# The files of the page become part of the program: the assembler includes their bytes. PAGE_SOURCE is the source that has
# them. No other tool is needed, and a change of a file compiles that source anew.
file(GLOB page_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.html ${CMAKE_CURRENT_LIST_DIR}/*.js
  ${CMAKE_CURRENT_LIST_DIR}/*.css ${CMAKE_CURRENT_LIST_DIR}/*.svg)
set(page_symbols "")
set(page_assembly "")
set(page_rows "")
set(page_count 0)
foreach(file ${page_files})
  get_filename_component(name ${file} NAME)
  set(symbol navcal_page_${page_count})
  string(APPEND page_assembly
    "asm(\".pushsection .rodata\\n${symbol}:\\n.incbin \\\"${file}\\\"\\n${symbol}_end:\\n.byte 0\\n.popsection\\n\");\n")
  string(APPEND page_symbols "extern const char ${symbol}[], ${symbol}_end[];\n")
  string(APPEND page_rows "      {\"${name}\", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},\n")
  math(EXPR page_count "${page_count} + 1")
endforeach()
set(PAGE_SOURCE ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp)
configure_file(${CMAKE_CURRENT_LIST_DIR}/page_files.cpp.in ${PAGE_SOURCE} @ONLY)
set_source_files_properties(${PAGE_SOURCE} PROPERTIES OBJECT_DEPENDS "${page_files}" SKIP_UNITY_BUILD_INCLUSION ON)
