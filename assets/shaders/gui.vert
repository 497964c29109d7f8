#version 330 core
// ImGui's triangles: framebuffer pixels, y down.

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 textureCoordinate;
layout(location = 2) in vec4 color;  // sRGB-encoded, straight alpha

uniform vec2 framebufferSize;

out vec2 at;
out vec4 tint;

void main() {
  at = textureCoordinate;
  tint = color;
  vec2 share = position / framebufferSize;
  gl_Position = vec4(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y, 0.0, 1.0);
}
