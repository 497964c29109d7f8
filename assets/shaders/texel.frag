#version 330 core
// What an image, stretched over the picture's area, has at a pixel of the framebuffer. Linked with picture.frag and with
// overlay.frag.

uniform sampler2D image;          // row 0 at the top
uniform float framebufferHeight;  // window coordinates here count from below
uniform vec2 origin;              // of the picture on the framebuffer, from the top left
uniform vec2 imageSize;           // of the picture, in its pixels
uniform float scale;              // framebuffer pixels per pixel of the picture
uniform vec2 columns;             // from and to which share of the picture's width is drawn

// Premultiplied. At and above 1:1 that of one texel; below, the mean over the area that the framebuffer's pixel covers,
// of at most about eight texels each way. Discards what is beside the picture or outside `columns`.
vec4 shownTexel() {
  vec2 position = vec2(gl_FragCoord.x, framebufferHeight - gl_FragCoord.y);
  vec2 at = (position - origin) / (scale * imageSize);
  if (at.x < columns.x || at.x >= columns.y || at.y < 0.0 || at.y >= 1.0) discard;

  ivec2 size = textureSize(image, 0);
  vec2 centre = at * vec2(size);
  if (scale >= 1.0) {
    vec4 texel = texelFetch(image, clamp(ivec2(floor(centre)), ivec2(0), size - 1), 0);
    return vec4(texel.rgb * texel.a, texel.a);
  }
  vec2 width = vec2(size) / (scale * imageSize);
  vec2 lower = max(centre - 0.5 * width, vec2(0.0));
  vec2 upper = min(centre + 0.5 * width, vec2(size));
  ivec2 stride = ivec2(ceil(width / 8.0));
  vec4 sum = vec4(0.0);
  float area = 0.0;
  for (int y = int(lower.y); float(y) < upper.y; y += stride.y) {
    float height = min(upper.y, float(y + 1)) - max(lower.y, float(y));
    for (int x = int(lower.x); float(x) < upper.x; x += stride.x) {
      vec4 texel = texelFetch(image, ivec2(x, y), 0);
      float weight = height * (min(upper.x, float(x + 1)) - max(lower.x, float(x)));
      sum += weight * vec4(texel.rgb * texel.a, texel.a);
      area += weight;
    }
  }
  return sum / area;
}
