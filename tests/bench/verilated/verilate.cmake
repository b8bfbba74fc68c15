# cmake -DVERILATOR=... -DTOP=... -DNAME=... -DDIR=... -DPARTS=n "-DSOURCES=a b c" "-DFLAGS=..." -P verilate.cmake
# Verilator decides by itself how many C++ files it writes; a build wants to know beforehand. So they are
# included by PARTS files with fixed names, DIR/NAME_0.cpp and on, which compile side by side.
separate_arguments(sources UNIX_COMMAND "${SOURCES}")
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
file(REMOVE_RECURSE ${DIR}/obj)
# Widths differ on purpose wherever a code is cut to its format; comparisons with 0 are constant in some rows.
execute_process(
  COMMAND ${VERILATOR} --cc -O3 --x-assign fast --x-initial fast --noassert -Wno-WIDTH -Wno-UNSIGNED --top-module ${TOP}
          --prefix ${NAME} -Mdir ${DIR}/obj ${flags} ${sources} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB written ${DIR}/obj/*.cpp)
list(SORT written)
math(EXPR last "${PARTS} - 1")
foreach(part RANGE ${last})
  set(text_${part} "")
endforeach()
set(part 0)
foreach(file ${written})
  string(APPEND text_${part} "#include \"${file}\"\n")
  math(EXPR part "(${part} + 1) % ${PARTS}")
endforeach()
foreach(part RANGE ${last})
  file(WRITE ${DIR}/${NAME}_${part}.cpp "${text_${part}}")
endforeach()
