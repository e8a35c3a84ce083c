// Horizon to zenith by the sine of elevation.
layout(location = 0) out vec4 colour;

void main() {
    vec3 d = ray(gl_FragCoord.xy);
    float elevation = clamp((mat3(scene_from_eye) * d).z / length(d), 0.0, 1.0);
    colour = vec4(mix(horizon.rgb, zenith.rgb, elevation), 1.0);
}
