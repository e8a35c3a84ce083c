// The plane Z = 0, from either side: object 0.
layout(location = 0) out uvec2 seen;

void main() {
    float u = -dot(up.xyz, ray(gl_FragCoord.xy)) / up.w;
    if (!(u > 0.0)) discard;
    gl_FragDepth = near * u;
    seen = uvec2(kPlaneWithoutEnd, floatBitsToUint(u));
}
