# The same bits with 1, 2 and 4 threads, and after stopping half way and going on.
# cmake -D PROGRAM= -D CASE= -D FLUID= -D OUT= -D TESTS=<this folder> -P same.cmake
set(fluid "")
if(NOT FLUID STREQUAL solid)
  set(fluid --fluid ${FLUID})
endif()

function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "exit status ${result}: ${ARGN}")
  endif()
endfunction()

# a metric may be missed by so short a run
function(run folder)
  execute_process(COMMAND ${PROGRAM} run ${CASE}/scene.json ${fluid} --quick --force --quiet --out ${OUT}/${folder} ${ARGN}
                  RESULT_VARIABLE result)
  if(NOT result MATCHES "^[01]$")
    message(FATAL_ERROR "exit status ${result}: ${folder}")
  endif()
endfunction()

# a fiftieth of the run is enough; cmake calculates with whole numbers only
file(READ ${CASE}/scene.json scene)
string(JSON end ERROR_VARIABLE none GET "${scene}" quick time.end)
if(none)
  string(JSON end GET "${scene}" time end)
endif()
execute_process(COMMAND /usr/bin/python3 -c "print(${end}/50, end='')" OUTPUT_VARIABLE end)

foreach(threads 1 2 4)
  run(threads${threads} --threads ${threads} --until ${end})
endforeach()
execute_process(COMMAND /usr/bin/python3 ${TESTS}/same_run.py ${OUT}/threads1 OUTPUT_VARIABLE half OUTPUT_STRIP_TRAILING_WHITESPACE)
run(halves --threads 2 --until ${half})
execute_process(COMMAND ${PROGRAM} resume ${OUT}/halves --threads 1 --until ${end} --quiet RESULT_VARIABLE result)
if(NOT result MATCHES "^[01]$")
  message(FATAL_ERROR "exit status ${result}: resume")
endif()
foreach(other threads2 threads4 halves)
  must(/usr/bin/python3 ${TESTS}/same_run.py ${OUT}/threads1 ${OUT}/${other})
endforeach()
