// A cloud deck, blended over what is behind it; with FORWARD also the ground: object `first`, whose anchor's z is the eye's height above it.
uniform usampler2D seen;
uniform int first;
layout(location = 0) out vec4 colour;

void main() {
    vec3 d = ray(gl_FragCoord.xy);
    float u = -dot(up.xyz, d) / texelFetch(objects, first * kTexels).z;
#ifdef FORWARD
    if (!(u > 0.0)) discard;
    gl_FragDepth = near * u;
#else
    if (!(u > uintBitsToFloat(texelFetch(seen, ivec2(gl_FragCoord.xy), 0).y))) discard;
#endif
    colour = painted(texelFetch(objects, first * kTexels + 4), texelFetch(objects, first * kTexels + 5), d, 1.0 / u,
                     up.xyz, 1.0);
}
