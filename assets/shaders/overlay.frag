#version 330 core
// Colours over the picture: sRGB-encoded, their alpha straight in the image and premultiplied on the screen.

uniform float opacity;

out vec4 shown;

vec4 shownTexel();  // texel.frag

void main() { shown = opacity * shownTexel(); }
