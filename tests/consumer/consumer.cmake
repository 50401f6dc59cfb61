# Installs BUILD into a folder of its own, builds the consumer against that and runs it; then the
# installed program, which finds all that it needs.
cmake_minimum_required(VERSION 3.25)
set(place ${BUILD}/consumer)
file(REMOVE_RECURSE ${place})
file(MAKE_DIRECTORY ${place}/data)
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place}/build -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${place}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
    "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=${TYPE} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${place}/build)
run(${place}/build/consumer ${place}/data)
run(${CMAKE_COMMAND} -E env --unset=OCIO
    ${place}/prefix/bin/abrdf preview ${place}/data/cloth.exr -o ${place}/data/ball.png --size 32x32)
foreach(file bin/abrdf share/man/man1/abrdf.1 share/bash-completion/completions/abrdf
             share/zsh/vendor-completions/_abrdf share/fish/vendor_completions.d/abrdf.fish
             share/abrdf/config.ocio share/doc/abrdf/README.md)
  if(NOT EXISTS ${place}/prefix/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()
file(REMOVE_RECURSE ${place})
