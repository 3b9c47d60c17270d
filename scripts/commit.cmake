# SPDX-License-Identifier: BSD-3-Clause
# cmake -P commit.cmake SOURCE_DIR FILE: makes FILE from FILE.in with the commit that is checked out, and leaves FILE
# alone when that has not changed.
set(source_dir ${CMAKE_ARGV3})
set(file ${CMAKE_ARGV4})
set(commit)
if(EXISTS ${source_dir}/.git)
  execute_process(
    COMMAND git -C ${source_dir} describe --always --dirty
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT commit)
  set(commit unknown)
endif()
configure_file(${file}.in ${file} @ONLY)
