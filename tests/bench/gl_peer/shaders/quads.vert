// One rectangle of the picture for each object, at the nearest depth its solid can have.
uniform int first;
flat out vec4 record_a, record_b, record_c, record_d;
flat out int object;

void main() {
    object = first + gl_InstanceID;
    int at = object * kTexels;
    record_a = texelFetch(objects, at);
    record_b = texelFetch(objects, at + 1);
    record_c = texelFetch(objects, at + 2);
    record_d = texelFetch(objects, at + 3);
    vec4 rectangle = texelFetch(objects, at + 6);
    float nearest = texelFetch(objects, at + 7).x;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(mix(rectangle.xy, rectangle.zw, corner), nearest, 1.0);
}
