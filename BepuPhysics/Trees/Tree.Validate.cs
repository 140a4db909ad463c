using System.Numerics;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>
    /// Walks all invariants: links both ways, leaf counts, heights, order, and boxes that are exactly those around their children.
    /// </summary>
    /// <exception cref="PhysicsInvariantException">Something does not hold; the message says what and where.</exception>
    public readonly void Validate() => Validate(tightBounds: true);

    /// <summary>As <see cref="Validate()"/>; without tight bounds the boxes need not fit, as between writing through bounds pointers and
    /// the refit.</summary>
    public readonly void Validate(bool tightBounds)
    {
        Require(LeafCount >= 0 && LeafCount <= Leaves.Length, "leaf count", LeafCount);
        Require(NodeCount <= Nodes.Length && NodeCount <= Metanodes.Length, "node count", NodeCount);
        if (LeafCount == 0)
            return;
        Require(Metanodes[0].ParentSlot == -1, "root's parent", 0);
        Require(Height <= MaximumHeight, "height", Height);
        Require(Nodes[0].A.LeafCount + Nodes[0].B.LeafCount == LeafCount, "root's leaf count", 0);
        if (LeafCount == 1)
        {
            Require(Nodes[0].A.Index == -1 && Leaves[0].Slot == 0 && Nodes[0].B.LeafCount == 0, "single leaf", 0);
            Require(BoxMath.IsValid(Nodes[0].A.Min, Nodes[0].A.Max), "box of leaf", 0);
            return;
        }

        // Every node but the root has a parent that points back, and counts shrink on the way down: so the links form one tree.
        for (var node = 0; node < NodeCount; ++node)
        {
            ValidateChild(2 * node, tightBounds);
            ValidateChild(2 * node + 1, tightBounds);
            Require(Metanodes[node].Height == MeasureHeight(node), "height of node", node);
            if (isDepthFirst)
            {
                Require(Nodes[node].A.Index < 0 || Nodes[node].A.Index == node + 1, "order of node", node);
                Require(Nodes[node].B.Index < 0 || Nodes[node].B.Index == node + Nodes[node].A.LeafCount, "order of node", node);
            }
            if (node > 0)
            {
                var slot = Metanodes[node].ParentSlot;
                Require(slot >= 0 && slot < 2 * NodeCount && Children[slot].Index == node, "parent of node", node);
            }
        }
        for (var leaf = 0; leaf < LeafCount; ++leaf)
        {
            var slot = Leaves[leaf].Slot;
            Require(slot >= 0 && slot < 2 * NodeCount && Children[slot].Index == ~leaf, "slot of leaf", leaf);
        }
    }

    readonly void ValidateChild(int slot, bool tightBounds)
    {
        var child = Children[slot];
        Require(BoxMath.IsValid(child.Min, child.Max), "box at slot", slot);
        if (child.Index < 0)
        {
            Require(~child.Index < LeafCount && Leaves[~child.Index].Slot == slot && child.LeafCount == 1, "leaf at slot", slot);
            return;
        }
        Require(child.Index < NodeCount && Metanodes[child.Index].ParentSlot == slot, "node at slot", slot);
        ref var node = ref Nodes[child.Index];
        Require(node.A.LeafCount >= 1 && node.B.LeafCount >= 1, "empty side below slot", slot);
        Require(node.A.LeafCount + node.B.LeafCount == child.LeafCount, "leaf count at slot", slot);
        if (tightBounds)
        {
            Require(child.Min == Lower(node.A.Min, node.B.Min), "lower corner at slot", slot);
            Require(child.Max == -Lower(-node.A.Max, -node.B.Max), "upper corner at slot", slot);
        }
    }

    static Vector3 Lower(Vector3 a, Vector3 b) => new(a.X < b.X ? a.X : b.X, a.Y < b.Y ? a.Y : b.Y, a.Z < b.Z ? a.Z : b.Z);

    static void Require(bool condition, string what, int where)
    {
        if (!condition)
            throw new PhysicsInvariantException($"Tree: wrong {what} ({where}).");
    }
}
