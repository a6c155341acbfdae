# SPDX-License-Identifier: Apache-2.0
# Fails when a module includes a module that is not on its list, when Embree or OpenCV leave their rooms, or when a
# module of the code is missing here.
# Run: cmake -DROOT=<repository root> -P tests/architecture_test.cmake
cmake_minimum_required(VERSION 3.25)

set(allowed_renderer_core "")
set(allowed_renderer_lens renderer/core)
set(allowed_renderer_sequence renderer/core renderer/lens)
set(allowed_renderer_trace renderer/core renderer/lens renderer/sequence)
set(allowed_renderer_film renderer/core renderer/lens renderer/sequence renderer/trace)
set(allowed_renderer renderer/core renderer/lens renderer/sequence renderer/trace renderer/film)
# Scenes are plain values: of the tracer trace/scene.h and the colour formulas of trace/color.h (a header alone), and the
# description of what to build.
set(allowed_scenes renderer/core renderer/lens renderer/sequence renderer/trace/color.h renderer/trace/scene.h)
# The validator sees what is on disk; the ray-traced ground truth needs the scene of the folder and rays in it.
set(allowed_validator renderer/core renderer/lens renderer/sequence renderer/trace/ray_scene.h renderer/trace/scene.h
    scenes/gltf/gltf_reader.h)
set(allowed_tools renderer scenes validator renderer/core renderer/lens renderer/sequence renderer/trace renderer/film)

set(modules renderer/core renderer/lens renderer/sequence renderer/trace renderer/film renderer scenes validator tools)

# The module of a path: the first of the list that it starts with.
function(module_of path result)
  foreach(module IN LISTS modules)
    if(path MATCHES "^${module}/")
      set(${result} ${module} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${result} "" PARENT_SCOPE)
endfunction()

set(violations "")
set(num_edges 0)
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/renderer/*.h" "${ROOT}/renderer/*.cpp" "${ROOT}/scenes/*.h"
     "${ROOT}/scenes/*.cpp" "${ROOT}/validator/*.h" "${ROOT}/validator/*.cpp" "${ROOT}/tools/*.h" "${ROOT}/tools/*.cpp")
foreach(file IN LISTS files)
  module_of("${file}" module)
  string(REPLACE "/" "_" key "${module}")
  if(file MATCHES "^renderer/[a-z_]+/" AND module STREQUAL "renderer")
    list(APPEND violations "${file}: its folder is no module of the list")
  endif()
  file(STRINGS "${ROOT}/${file}" includes REGEX "^#include ")
  foreach(line IN LISTS includes)
    if(line MATCHES "^#include <embree" AND NOT file STREQUAL "renderer/trace/ray_scene.cpp")
      list(APPEND violations "${file} must not include Embree")
    endif()
    if(line MATCHES "^#include <opencv2" AND NOT module STREQUAL "validator")
      list(APPEND violations "${file} must not include OpenCV")
    endif()
    if(NOT line MATCHES "^#include \"([^\"]+)\"")
      continue()
    endif()
    set(target "${CMAKE_MATCH_1}")
    module_of("${target}" target_module)
    if(target_module STREQUAL module)
      continue()
    endif()
    math(EXPR num_edges "${num_edges} + 1")
    if(target_module STREQUAL "")
      list(APPEND violations "${file} includes ${target}: write the path from the repository's root")
    elseif(NOT target_module IN_LIST allowed_${key} AND NOT target IN_LIST allowed_${key})
      list(APPEND violations "${file} must not include ${target}")
    endif()
  endforeach()
endforeach()

if(num_edges EQUAL 0)
  message(FATAL_ERROR "found no include between modules under '${ROOT}': is this the root?")
endif()
if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "forbidden include edges:\n  ${text}")
endif()
message(STATUS "${num_edges} include edges between modules, all allowed")
