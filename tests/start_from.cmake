# A run that starts from another one's end. cmake -D PROGRAM= -D OUT= -D TESTS=<this folder> -P start_from.cmake
function(run expected pattern folder)
  execute_process(COMMAND ${PROGRAM} run ${ARGN} --threads 1 --quiet --out ${OUT}/${folder}
                  RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result MATCHES "^${expected}$" OR NOT "${error}" MATCHES "${pattern}")
    message(FATAL_ERROR "${folder}: exit status ${result} instead of ${expected}, or no \"${pattern}\" in\n${error}")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT})
# the two-point path averages its pressure every so many steps, counted from the start: both halves have a multiple of 4
set(column terzaghi_column --quick --set output.interval=1e-3 --set numerics.twopoint.averaging_interval=4)
foreach(path ice twopoint)
  run(0 "" ${path}-first ${column} --fluid ${path} --until 4e-3)
  run(0 "" ${path}-second ${column} --fluid ${path} --until 4e-3 --set start_from=${OUT}/${path}-first)
  run(0 "" ${path}-whole ${column} --fluid ${path} --until 8e-3)
  execute_process(COMMAND /usr/bin/python3 ${TESTS}/start_from.py ${OUT}/${path}-first ${OUT}/${path}-second ${OUT}/${path}-whole
                  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${path}: ${said}${error}")
  endif()
endforeach()

set(from --set start_from=${OUT}/ice-first)
run(2 "start_from: .*no run is in this folder" nowhere ${column} --set start_from=${OUT}/nothing)
run(2 "start_from: .*other grid" grid ${column} ${from} --set grid.h=0.02)
run(2 "start_from: .*other loads" load ${column} ${from} --set "loads.top.on={\"box\": {\"min\": [null, 0.92], \"max\": [null, 0.92]}}")
run(2 "start_from: .*does not fit" path ${column} --fluid twopoint ${from})
foreach(folder nowhere grid load path)
  if(EXISTS ${OUT}/${folder}/summary.json)
    message(FATAL_ERROR "${folder}: something was written")
  endif()
endforeach()
