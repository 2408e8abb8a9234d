// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Example: the shadow map of a directional light of Unity (built-in pipeline, one cascade) as a bundle. Excerpt to copy
// from; it is compiled by no test. It writes frame.json and a raw map by itself, and leaves the scene to a glTF
// exporter, such as UnityGLTF, whose file is put beside frame.json as scene.glb.
//
// Traps of Unity:
// - The world is left-handed, y up, in metres. glTF exporters turn it to right-handed by negating one axis. Positions and
//   matrices of a bundle lie in one space, so the code below negates x. Change Turned() if your exporter negates z.
// - Light.transform.forward is the direction in which the light shines.
// - GL.GetGPUProjectionMatrix() gives what the shader sees: y is flipped for textures on Direct3D, Vulkan and Metal, and
//   depth is reversed there (SystemInfo.usesReversedZBuffer), with the range 0 to 1. On OpenGL the range is -1 to 1.
// - A shadow map is a depth texture with comparison. Sample it with SetShadowSamplingMode(RawDepth), else the copy holds
//   results of comparisons.
// - Texture2D.GetRawTextureData() has its first row at v = 0. The code writes the matrix that drew, flip included. For it
//   v = 0 is clip y = +1 where textures start at the top (Direct3D, Vulkan, Metal), and clip y = -1 on OpenGL.
// - URP and HDRP keep an atlas and one matrix a slice. Write a map per slice with its region, and the matrices without
//   the half-and-half that GetShadowTransform() multiplies into them for the look-up.
// - Unity's own bias moves casters along their normals and along the light while the map is drawn. It is no polygon
//   offset and no term of the look-up: leave both out, or set Light.shadowBias and shadowNormalBias to 0 and state 0.
using System.Globalization;
using System.IO;
using System.Text;
using UnityEngine;
using UnityEngine.Rendering;

[RequireComponent(typeof(Light))]
public class ShadowBundle : MonoBehaviour
{
    public string folder = "frame.bundle";
    public Camera view;

    // Matrices of the caster pass. A replacement camera that follows the light, or URP's ShadowSliceData, has them.
    public Matrix4x4 lightView, lightProjection;

    RenderTexture copy;

    void OnEnable()
    {
        copy = new RenderTexture(2048, 2048, 0, RenderTextureFormat.RFloat);
        var commands = new CommandBuffer { name = "copy the shadow map" };
        commands.SetShadowSamplingMode(BuiltinRenderTextureType.CurrentActive, ShadowSamplingMode.RawDepth);
        commands.Blit(BuiltinRenderTextureType.CurrentActive, copy);
        GetComponent<Light>().AddCommandBuffer(LightEvent.AfterShadowMap, commands);
    }

    void Update()
    {
        if (Input.GetKeyDown(KeyCode.B)) Write();
    }

    void Write()
    {
        Directory.CreateDirectory(folder);
        var texels = new Texture2D(copy.width, copy.height, TextureFormat.RFloat, false, true);
        RenderTexture.active = copy;
        texels.ReadPixels(new Rect(0, 0, copy.width, copy.height), 0, 0);
        RenderTexture.active = null;
        File.WriteAllBytes(Path.Combine(folder, "sun.raw"), texels.GetRawTextureData());

        bool reversed = SystemInfo.usesReversedZBuffer;
        string range = reversed ? "0..1" : "-1..1";
        Matrix4x4 light = GL.GetGPUProjectionMatrix(lightProjection, true) * lightView;
        Matrix4x4 camera = GL.GetGPUProjectionMatrix(view.projectionMatrix, false) * view.worldToCameraMatrix;
        Vector3 direction = transform.forward;
        string frame = "{\n" +
            " \"bundle\": 1, \"made_by\": \"Unity " + Application.unityVersion + "\", \"scene\": \"scene.glb\",\n" +
            " \"camera\": {\"clip_from_world\": " + Turned(camera) + ", \"width\": " + view.pixelWidth +
            ", \"height\": " + view.pixelHeight + ", \"depth\": {\"range\": \"" + range + "\", \"reversed\": " +
            (reversed ? "true" : "false") + "}},\n" +
            " \"lights\": [{\"name\": \"sun\", \"type\": \"directional\", \"direction\": [" + Text(-direction.x) + ", " +
            Text(direction.y) + ", " + Text(direction.z) + "],\n" +
            "  \"maps\": [{\"image\": {\"file\": \"sun.raw\", \"format\": \"f32\", \"width\": " + copy.width +
            ", \"height\": " + copy.height + ", \"first_row\": \"" +
            (SystemInfo.graphicsUVStartsAtTop ? "top" : "bottom") + "\"},\n" +
            "   \"clip_from_world\": " + Turned(light) + ",\n" +
            "   \"depth\": {\"range\": \"" + range + "\", \"reversed\": " + (reversed ? "true" : "false") +
            ", \"format\": \"d32f\"}}],\n" +
            // The look-up of the built-in pipeline is not stated, so it is unknown.
            "  \"lookup\": {}}]\n}\n";
        // frame.json comes last: a folder without it is no bundle.
        string part = Path.Combine(folder, "frame.json.part");
        File.WriteAllText(part, frame, new UTF8Encoding(false));
        File.Move(part, Path.Combine(folder, "frame.json"));
    }

    // Returns a matrix for a world whose x is negated, by columns. Matrix4x4[i] counts by columns, too.
    static string Turned(Matrix4x4 m)
    {
        m *= Matrix4x4.Scale(new Vector3(-1, 1, 1));
        var text = new StringBuilder("[");
        for (int i = 0; i < 16; ++i) text.Append(i > 0 ? ", " : "").Append(Text(m[i]));
        return text.Append("]").ToString();
    }

    // A decimal comma is no JSON.
    static string Text(float value)
    {
        return value.ToString("R", CultureInfo.InvariantCulture);
    }
}
