// Linear light to sRGB (IEC 61966-2-1).
uniform sampler2D picture;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(encoded(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
