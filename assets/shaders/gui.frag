#version 330 core

uniform sampler2D image;

in vec2 at;
in vec4 tint;

out vec4 shown;

void main() { shown = tint * texture(image, at); }
