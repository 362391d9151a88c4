// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the light that arrives at each pixel. The host says which layer holds each kind; -1: none does.

const int INCIDENT_DIFFUSE_DIRECT = -1;         // irradiance [W m^-2] that was drawn
const int INCIDENT_DIFFUSE_INDIRECT = -1;       // all other irradiance
const int INCIDENT_DIFFUSE_FOUND = -1;          // that part of it which rays met at emitters or in the world
const int INCIDENT_GLOSSY_DIRECT = -1;          // radiance [W m^-2 sr^-1] towards the eye, straight from lights
const int INCIDENT_GLOSSY_INDIRECT = -1;        // by way of other surfaces; alpha: how far away, see `apartness`
const int INCIDENT_TRANSMISSION_DIRECT = -1;
const int INCIDENT_TRANSMISSION_INDIRECT = -1;

layout(rgba32f) uniform image2DArray u_incident;

void arrive(ivec2 pixel, int kind, vec4 value)
{
    if (kind >= 0)
        imageStore(u_incident, ivec3(pixel, kind), value);
}

vec4 arrived(ivec2 pixel, int kind)
{
    return kind >= 0 ? imageLoad(u_incident, ivec3(pixel, kind)) : vec4(0.0);
}

// The part of the way from the eye to what a surface reflects that lies behind the surface: 0 where they touch.
float apartness(float to_surface, float to_reflected)
{
    return to_reflected / max(to_surface + to_reflected, 1e-9);
}
