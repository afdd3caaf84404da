# cmake -D SOURCE=folder -D HEADER=file -P commit.cmake: writes the commit of a source folder into a header, which stays
# as it is where it says so already.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=10 HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define OTTER_COMMIT \"@commit@\"\n" @ONLY)
