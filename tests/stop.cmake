# A run that is stopped, and its folder used again. cmake -D PROGRAM= -D OUT= -P stop.cmake
function(run expected pattern)
  execute_process(COMMAND ${ARGN} --threads 1 --out ${OUT} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE error)
  if(NOT result EQUAL expected OR NOT "${said}${error}" MATCHES "${pattern}" OR "${said}${error}" MATCHES "MISSED")
    message(FATAL_ERROR "${ARGN}: exit status ${result} instead of ${expected}, or no \"${pattern}\" in\n${said}${error}")
  endif()
endfunction()

function(look_for)
  foreach(file ${ARGN})
    if(NOT EXISTS ${OUT}/${file})
      message(FATAL_ERROR "${file} is gone")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE ${OUT})
# timeout tells the program and then its whole group; the run has 2e6 steps, its metric lies at the end
run(130 "files: ${OUT}" timeout --signal INT --preserve-status 1.5 ${PROGRAM} run terzaghi_column+k1e-7)
file(READ ${OUT}/summary.json json)
string(JSON status GET "${json}" status)
string(JSON late ERROR_VARIABLE none GET "${json}" metrics p_rms_0.05)
if(NOT status STREQUAL interrupted OR NOT none)
  message(FATAL_ERROR "status ${status}, metric of a time that was not reached: ${late}")
endif()
look_for(checkpoint.h5)

# a scene that cannot run leaves everything as it is
run(2 "scatter" ${PROGRAM} run terzaghi_column --force --set metrics.p_rms_0.1.measure=scatter)
look_for(summary.json gauges.csv checkpoint.h5 fields.cells.00000.hdf)

# another one takes the folder, but not what is not the program's
file(WRITE ${OUT}/fields.cells.00099.hdf "of an earlier run")
file(WRITE ${OUT}/fields.txt "somebody's notes")
run(0 "files: ${OUT}" ${PROGRAM} run terzaghi_column --quick --until 1e-3 --force)
look_for(summary.json gauges.csv fields.cells.00000.hdf fields.txt)
if(EXISTS ${OUT}/fields.cells.00099.hdf)
  message(FATAL_ERROR "a snapshot of the earlier run was left")
endif()
