# What the windows need; CELLCUT_UI_FOUND says whether all of it is there.
find_package(glfw3 3.3 QUIET)
find_path(EPOXY_INCLUDE_DIR epoxy/egl.h)
find_library(EPOXY_LIBRARY epoxy)
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(IMGUI_LIBRARY imgui)
find_path(EGL_INCLUDE_DIR EGL/eglplatform.h) # epoxy/egl.h includes it
mark_as_advanced(EPOXY_INCLUDE_DIR EPOXY_LIBRARY IMGUI_INCLUDE_DIR IMGUI_LIBRARY EGL_INCLUDE_DIR)

set(CELLCUT_UI_MISSING)
foreach(part "glfw3_FOUND=libglfw3-dev" "EPOXY_INCLUDE_DIR=libepoxy-dev" "EPOXY_LIBRARY=libepoxy-dev"
    "IMGUI_INCLUDE_DIR=libimgui-dev" "IMGUI_LIBRARY=libimgui-dev" "EGL_INCLUDE_DIR=libegl-dev")
  string(REGEX REPLACE "=.*" "" variable ${part})
  string(REGEX REPLACE ".*=" "" package ${part})
  if(NOT ${variable})
    list(APPEND CELLCUT_UI_MISSING ${package})
  endif()
endforeach()
list(REMOVE_DUPLICATES CELLCUT_UI_MISSING)
if(CELLCUT_UI_MISSING)
  set(CELLCUT_UI_FOUND OFF)
else()
  set(CELLCUT_UI_FOUND ON)
endif()
