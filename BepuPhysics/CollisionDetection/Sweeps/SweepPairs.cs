using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Two shapes of any types that move: their parts against each other.</summary>
static unsafe class SweepPairs
{
    /// <summary>Whether shapes of a type can be swept, or met by what is swept.</summary>
    public static bool IsKnown(int typeId) => ImpactCore.Exists(typeId) || ContainerChildren.IsContainer(typeId);

    /// <summary>Whether shapes of a type, which may be a game's own, can be swept, or met by what is swept.</summary>
    public static bool IsKnown(int typeId, Shapes shapes) =>
        typeId <= ShapeLimits.LastTypeId ? IsKnown(typeId) : shapes.FindBatch(typeId) is IHomogeneousBatch or IConvexCoreBatch;

    /// <summary>Tests two shapes.</summary>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="typeA">Type of the first shape.</param>
    /// <param name="a">The first shape.</param>
    /// <param name="typeB">Type of the second shape.</param>
    /// <param name="b">The second shape.</param>
    /// <param name="filter">Chooses children.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="hit">The first impact.</param>
    public static void Test<TFilter>(in SweepMotion motion, int typeA, void* a, int typeB, void* b, ref TFilter filter,
        Shapes shapes, BufferPool pool, out SweepHit hit) where TFilter : ISweepFilter
    {
        hit = default;
        if (ImpactCore.Exists(typeA, shapes))
        {
            var part = new ImpactBody(motion.CoreOf(typeA, a, shapes), motion.OrientationA, motion.AngularA);
            TestPart(motion, ref part, 0, typeB, b, ref filter, false, shapes, pool, ref hit);
            return;
        }
        if (!ImpactCore.Exists(typeB, shapes))
        {
            var children = new Children<TFilter>(motion, typeB, b, ref filter, shapes, pool, ref hit);
            ContainerTypes.TryUse(typeA, a, shapes, ref children);
            return;
        }
        var flipped = motion with
        {
            OrientationA = motion.OrientationB,
            OrientationB = motion.OrientationA,
            LinearA = motion.LinearB,
            LinearB = motion.LinearA,
            AngularA = motion.AngularB,
            AngularB = motion.AngularA,
            OffsetB = -motion.OffsetB,
        };
        var partB = new ImpactBody(motion.CoreOf(typeB, b, shapes), flipped.OrientationA, flipped.AngularA);
        TestPart(flipped, ref partB, 0, typeA, a, ref filter, true, shapes, pool, ref hit);
        hit.Normal = -hit.Normal;
        hit.Place += motion.OffsetB;
    }

    /// <summary>Tests a convex part of A.</summary>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="part">The part, at the time zero.</param>
    /// <param name="partIndex">Its number.</param>
    /// <param name="typeB">Type of the second shape.</param>
    /// <param name="b">The second shape.</param>
    /// <param name="filter">Chooses children.</param>
    /// <param name="isFlipped">Whether the filter knows A as B.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="hit">The first impact; goes on from what it is.</param>
    public static void TestPart<TFilter>(in SweepMotion motion, ref ImpactBody part, int partIndex, int typeB, void* b,
        ref TFilter filter, bool isFlipped, Shapes shapes, BufferPool pool, ref SweepHit hit) where TFilter : ISweepFilter
    {
        var sweep = new ContainerSweep<TFilter>(motion, ref part, partIndex, ref filter, isFlipped, shapes, pool, ref hit);
        if (ContainerTypes.TryUse(typeB, b, shapes, ref sweep))
            return;
        var core = motion.CoreOf(typeB, b, shapes);
        part.Restart();
        if (!motion.BallsMeet(part, core, default, hit.LatestT(motion)))
            return;
        var body = new ImpactBody(core, motion.OrientationB, motion.AngularB);
        hit.Test(motion, ref part, ref body, partIndex, 0);
    }

    // All children of A, each against those of B that it may meet.
    ref struct Children<TFilter>(in SweepMotion motion, int typeB, void* b, ref TFilter filter, Shapes shapes, BufferPool pool, ref SweepHit hit)
        : IContainerUser where TFilter : ISweepFilter
    {
        readonly ref readonly SweepMotion motion = ref motion;
        readonly int typeB = typeB;
        readonly void* b = b;
        readonly ref TFilter filter = ref filter;
        readonly ref SweepHit hit = ref hit;

        public readonly void Use<TContainer>(in TContainer a) where TContainer : unmanaged, IContainer
        {
            SweepBounds.AroundB(motion, out var min, out var max);
            var children = new QuickList<int>(64, pool);
            var list = default(Buffer<NodeChild>);
            try
            {
                if (TContainer.IsList)
                    ContainerPlaces.Open(a, 0, shapes, ref list, pool);
                a.FindOverlaps(min, max, default, shapes, list.Memory, ref children, pool);
                var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
                for (int i = 0; i < children.Count && !hit.Overlaps; ++i)
                {
                    a.GetChild(children[i], shapes, (byte*)scratch, out var child);
                    if (!ImpactCore.Exists(child.TypeId, shapes))
                        continue;
                    var part = new ImpactBody(motion.CoreOf(child.TypeId, child.Shape, shapes), child.Pose, motion.OrientationA, motion.AngularA);
                    TestPart(motion, ref part, children[i], typeB, b, ref filter, false, shapes, pool, ref hit);
                }
            }
            finally
            {
                children.Dispose(pool);
                pool.ReturnIfTaken(ref list);
            }
        }
    }
}
