using System;
using System.Collections.Generic;
using Demos.Scenes.BuiltIn;

namespace Demos.Scenes;

/// <summary>Finds scenes by name or path.</summary>
public static class SceneLibrary
{
    /// <summary>The scene that runs when nobody asks for one.</summary>
    public const string DefaultScene = Pyramids.Name;

    /// <summary>All built-in scenes, in the order of the list.</summary>
    public static IReadOnlyList<BuiltInScene> Scenes { get; } =
    [
        Pyramids.Scene,
        GreatPyramid.Scene,
        ClothLattice.Scene,
        Pile.Scene,
        ShapePile.Scene,
        HullPile.Scene,
        RagdollTube.Scene,
        Washer.Scene,
        MeshTerrain.Scene,
        Tiles.Scene,
        GearsOfHulls.Scene,
        Tori.Scene,
        CylinderTower.Scene,
        Rolling.Scene,
        Coins.Scene,
        BuiltIn.Towers.Scene,
        Slope.Scene,
        Newton.Scene,
        Ragdolls.Scene,
        Chains.Hundredfold,
        Chains.Thousandfold,
        RopeNet.Scene,
        ManyStatics.Scene,
        Boulder.Scene,
        Rain.Scene,
        WakingWave.Scene,
        SettledCity.Scene,
        SettledCity.Alone,
    ];

    /// <summary>Makes the built-in scene of that name, or reads the file.</summary>
    /// <exception cref="SceneException">There is neither, or the file is wrong.</exception>
    public static SceneDescription Load(string nameOrPath, int seed)
    {
        ArgumentNullException.ThrowIfNull(nameOrPath);
        if (string.IsNullOrWhiteSpace(nameOrPath))
            throw new SceneException("a scene without a name; 'list' shows those that there are");
        foreach (BuiltInScene scene in Scenes)
        {
            if (scene.Name == nameOrPath)
                return scene.Create(seed);
        }
        // A name without a dot or a slash can only have meant a built-in scene.
        if (nameOrPath.AsSpan().IndexOfAny('.', '/', '\\') < 0 && !System.IO.File.Exists(nameOrPath))
            throw new SceneException($"there is no scene '{nameOrPath}'; 'list' shows those that there are");
        return SceneFile.Read(nameOrPath);
    }
}
