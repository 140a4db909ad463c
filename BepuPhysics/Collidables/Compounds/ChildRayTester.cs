using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Tests a ray against children of a compound, and tells the compound's handler about the hits with the number of the piece.</summary>
unsafe struct ChildRayTester(Buffer<CompoundChild> children, in RigidPose pose, in RayData ray, Shapes shapes, PieceHits hits) : IRayLeafTester
{
    readonly Buffer<CompoundChild> children = children;
    readonly RigidPose pose = pose;
    readonly RayData ray = ray;
    readonly Shapes shapes = shapes;
    PieceHits hits = hits;

    public void Test(int index, ref float maximumT, BufferPool pool)
    {
        ref var child = ref children[index];
        // What is made of children asks for each of them.
        if (ContainerChildren.IsContainer(child))
            hits.FirstPiece = ContainerChildren.Pieces(children).Of(index, 0);
        else if (hits.AllowsPiece(index))
            hits.FirstPiece = index;
        else
            return;
        var place = new RigidPose(
            pose.Position + Exact.Rotate(child.LocalPosition, pose.Orientation), Exact.Concatenate(child.LocalOrientation, pose.Orientation));
        shapes.GetBatch(child.ShapeIndex.Type).RayTest(child.ShapeIndex.Index, place, ray, ref maximumT, pool, ref hits);
    }

    // The tree's ray is the same one in the frame of the compound.
    void IRayLeafTester.TestLeaf(int leafIndex, RayData* rayData, float* maximumT, BufferPool pool) => Test(leafIndex, ref *maximumT, pool);
}
