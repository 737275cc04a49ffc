# movis_add_module(NAME SOURCES file... [USES module...] [PUBLIC lib...] [PRIVATE lib...])
#
# One target `movis::NAME` from include/movis/NAME/*.h and the sources. USES names the modules whose types appear in
# this module's headers. A module may use only modules that were added before it, so the order of the
# add_subdirectory lines in the top CMakeLists.txt is the link order of the whole system.
function(movis_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;USES;PUBLIC;PRIVATE")
  add_library(movis_${name} STATIC ${arg_SOURCES})
  add_library(movis::${name} ALIAS movis_${name})
  set_target_properties(movis_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(movis_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(movis_${name} PUBLIC cxx_std_17)
  set_target_properties(movis_${name} PROPERTIES CXX_STANDARD 17 CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  foreach(used IN LISTS arg_USES)
    if(NOT TARGET movis_${used})
      message(FATAL_ERROR "module '${name}' uses '${used}', which comes after it in the link order of CMakeLists.txt")
    endif()
    target_link_libraries(movis_${name} PUBLIC movis_${used})
  endforeach()
  target_link_libraries(movis_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY MOVIS_MODULES movis_${name})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# ViSP's headers as system headers, with only the ViSP modules that are asked for.
# movis_link_visp(TARGET PUBLIC|PRIVATE visp_module...)
function(movis_link_visp target visibility)
  target_link_libraries(${target} ${visibility} ${ARGN})
  target_include_directories(${target} SYSTEM ${visibility} ${VISP_INCLUDE_DIRS})
endfunction()
