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

# A metric may be missed by so short a run. Every run ends a step at half time: that is where one of them stops.
function(run folder)
  execute_process(COMMAND ${PROGRAM} run ${CASE}/scene.json ${fluid} --quick --force --quiet --set "output.times=[${half}]"
                          --out ${OUT}/${folder} ${ARGN}
                  RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result MATCHES "^[01]$")
    message(FATAL_ERROR "${folder}: exit status ${result}: ${error}")
  endif()
endfunction()

# a fiftieth of the run is enough; cmake calculates with whole numbers only
file(READ ${CASE}/scene.json scene)
string(JSON end ERROR_VARIABLE none GET "${scene}" quick time.end)
if(none)
  string(JSON end GET "${scene}" time end)
endif()
execute_process(COMMAND /usr/bin/python3 -c "print(${end}/100, ${end}/50)" OUTPUT_VARIABLE times)
string(REGEX MATCH "([^ ]+) ([^ \n]+)" none "${times}")
set(half ${CMAKE_MATCH_1})
set(end ${CMAKE_MATCH_2})

file(REMOVE_RECURSE ${OUT})
foreach(threads 1 2 4)
  run(threads${threads} --threads ${threads} --until ${end})
endforeach()
run(halves --threads 2 --until ${half})
execute_process(COMMAND ${PROGRAM} resume ${OUT}/halves --threads 1 --until ${end} --quiet RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result MATCHES "^[01]$")
  message(FATAL_ERROR "resume: exit status ${result}: ${error}")
endif()
foreach(other threads2 threads4 halves)
  must(/usr/bin/python3 ${TESTS}/same_run.py ${OUT}/threads1 ${OUT}/${other})
endforeach()
