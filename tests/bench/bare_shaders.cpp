// GLSL sources of the minimal renderer, put together from its options.
#include "tests/bench/bare_shaders.h"

#include <fmt/format.h>

namespace si {
namespace {

/// visible(s): visibility at map coordinates and depth s, 1 lit to 0 in shadow.
constexpr const char* kVisible = R"(
#if KERNEL == SAMPLER
layout(binding=0) uniform sampler2DShadow map;
#else
layout(binding=0) uniform sampler2D map;
#endif
const float T=1.0/float(N);
#if KERNEL == PCSS
uniform vec2 penumbra; // texels per depth behind a blocker, and before every one
float noise(vec2 p){ return 6.2831853*fract(52.9829189*fract(dot(p,vec2(0.06711056,0.00583715)))); }
const int TAPS=16;
vec2 place(int i){ float a=2.3999632*float(i); return sqrt((float(i)+0.5)/float(TAPS))*vec2(cos(a),sin(a)); }
#endif
float visible(vec3 s){
#if KERNEL == NEAREST
 return s.z <= texture(map,s.xy).r ? 1.0 : 0.0;
#elif KERNEL == SAMPLER
 float sum=0.0;
 for(int y=-(K/2);y<=K/2;++y) for(int x=-(K/2);x<=K/2;++x) sum+=texture(map,vec3(s.xy+vec2(x,y)*T,s.z));
 return sum*(1.0/float(K*K));
#elif KERNEL == GATHER
 const int R=K/2; vec2 at=s.xy*float(N)-0.5, b=floor(at), f=at-b; float sum=0.0;
 for(int y=0;y<=K;y+=2){ float y0=y==0?1.0-f.y:1.0,y1=y==K-1?f.y:1.0;
  for(int x=0;x<=K;x+=2){ float x0=x==0?1.0-f.x:1.0,x1=x==K-1?f.x:1.0;
   vec4 g=vec4(lessThanEqual(vec4(s.z),textureGather(map,(b+vec2(x-R+1,y-R+1))*T)));
   sum+=dot(g,vec4(x0*y1,x1*y1,x1*y0,x0*y0)); } }
 return sum*(1.0/float(K*K));
#elif KERNEL == VSM
 vec2 m=texture(map,s.xy).rg; float v=max(m.y-m.x*m.x,1e-6), d=s.z-m.x;
 return d<=0.0 ? 1.0 : clamp((v/(v+d*d)-0.2)*1.25,0.0,1.0);
#elif KERNEL == PCSS
 float a=noise(gl_FragCoord.xy-0.5), held=0.0, found=0.0; vec2 t=vec2(cos(a),sin(a));
 mat2 turn=mat2(t.x,t.y,-t.y,t.x)*T, search=turn*min(penumbra.x*s.z,16.0);
 for(int i=0;i<TAPS;++i){ float z=texture(map,s.xy+search*place(i)).r, blocks=z<s.z?1.0:0.0; held+=blocks*z; found+=blocks; }
 if(found==0.0) return 1.0;
 mat2 disk=turn*clamp(penumbra.x*(s.z-held/found),0.5,16.0); float sum=0.0;
 for(int i=0;i<TAPS;++i) sum+=s.z<=texture(map,s.xy+disk*place(i)).r?1.0:0.0;
 return sum*(1.0/float(TAPS));
#else
 return 1.0;
#endif
})";

constexpr const char* kFragment = R"(
#if PASS != VISIBILITY
in vec3 nor; flat in vec3 col;
#if OURS
in vec3 view;
#endif
#endif
#if PASS != READS
in vec3 at;
#endif
#if LOOK != COLOUR
in vec2 uv; layout(binding=1) uniform sampler2D base; uniform float cutoff;
#endif
uniform vec3 to_light;
#if PASS == VISIBILITY
layout(location=0) out float o;
#else
layout(location=0) out vec4 o;
#endif
#if PASS == READS
layout(binding=2) uniform sampler2D visibility;
#endif
#if OURS
vec3 srgb(vec3 c){ vec3 s=sqrt(c);
 return mix(12.92*c,((((0.5173020*s-1.6236548)*s+2.0315693)*s-1.4027332)*s+1.5179501)*s-0.0401096,greaterThan(c,vec3(0.0031308))); }
#endif
void main(){
#if LOOK != COLOUR
 vec4 t=texture(base,uv);
#endif
#if LOOK == MASKED
 if(t.a<cutoff) discard;
#endif
#if PASS == VISIBILITY
 o=visible(at);
#else
 vec3 albedo=col;
#if LOOK != COLOUR
 albedo*=t.rgb;
#endif
 vec3 n=normalize(nor);
 if(!gl_FrontFacing) n=-n;
#if PASS == READS
 float vis=texelFetch(visibility,ivec2(gl_FragCoord.xy),0).r;
#else
 float vis=visible(at);
#endif
 float nl=max(dot(n,to_light),0.0);
#if OURS
 vec3 v=normalize(view); float a=max(nl+dot(n,v),0.0), h=a*a/max(2.0+2.0*dot(v,to_light),1e-12);
 h*=h; h*=h; h*=h; h*=h;
 o=vec4(srgb((0.25+vis*(0.75*nl+(nl>0.0?0.15*h:0.0)))*albedo),1);
#else
 o=vec4((0.25+vis*0.75*nl)*albedo,1);
#endif
#endif
})";

std::string defines(const BareOptions& o, BarePass pass, BareLook look, int resolution) {
    return fmt::format(
        "#define NONE 0\n#define NEAREST 1\n#define GATHER 2\n#define SAMPLER 3\n#define VSM 4\n#define PCSS 5\n"
        "#define COLOUR 0\n#define TEXTURED 1\n#define MASKED 2\n"
        "#define FORWARD 0\n#define VISIBILITY 1\n#define READS 2\n"
        "#define KERNEL {}\n#define K {}\n#define N {}\n#define OURS {}\n#define PASS {}\n#define LOOK {}\n",
        int(o.kernel), o.size, resolution, int(o.light == BareLight::Ours), int(pass), int(look));
}

}  // namespace

std::string bare_camera_vertex(const BareOptions& options, BarePass pass) {
    return defines(options, pass, BareLook::Colour, 1) + R"(
layout(location=0) in vec3 p; layout(location=1) in vec3 n; layout(location=2) in vec3 c; layout(location=3) in vec2 t;
uniform mat4 clip, uvd; uniform vec3 eye; uniform float bias;
out vec3 at, nor, view; flat out vec3 col; out vec2 uv;
invariant gl_Position;
void main(){ at=(uvd*vec4(p,1)).xyz-vec3(0,0,bias); nor=n; col=c; view=eye-p; uv=t; gl_Position=clip*vec4(p,1); })";
}

std::string bare_camera_fragment(const BareOptions& options, BarePass pass, BareLook look, int map_resolution) {
    std::string out = defines(options, pass, look, map_resolution);
    if (pass != BarePass::ReadsVisibility) out += kVisible;
    return out + kFragment;
}

std::string bare_blur_fragment(int axis) {
    return fmt::format("#define AXIS {}\n", axis) + R"(
layout(binding=0) uniform sampler2D map; out vec2 o;
void main(){ ivec2 q=ivec2(gl_FragCoord.xy), e=textureSize(map,0)-1; vec2 sum=vec2(0);
 for(int k=-2;k<=2;++k){
#if AXIS == 0
  float z=texelFetch(map,clamp(q+ivec2(k,0),ivec2(0),e),0).r; sum+=vec2(z,z*z);
#else
  sum+=texelFetch(map,clamp(q+ivec2(0,k),ivec2(0),e),0).rg;
#endif
 }
 o=sum*0.2; })";
}

}  // namespace si
