# Installs the build tree BUILD, builds the consumer SOURCE against it in WORK, and runs consumer and program.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " line)
    message(FATAL_ERROR "failed: ${line}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=${TYPE} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
unset(ENV{MOVIS_DATA})
run(${WORK}/prefix/bin/movis demo --out ${WORK}/demo.html)  # finds the data beside its prefix
set(ENV{MOVIS_DATA} ${WORK}/prefix/share/movis/data)
run(${WORK}/build/consumer)
