using System.Linq;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.Trees;

/// <summary>What is handed out to the workers that look for overlaps.</summary>
public class OverlapPiecesTests
{
    [Theory]
    [InlineData(300, 1, 2)]
    [InlineData(2600, 40, 2)]
    [InlineData(2600, 40, 3)]
    [InlineData(9000, 3000, 16)]
    public void Each_piece_is_handed_out_once_in_the_order_of_space(int activeCount, int staticCount, int workerCount)
    {
        using var active = new TreeModel(TreeGenerators.World(activeCount, seed: 20, largest: 5));
        using var still = new TreeModel(TreeGenerators.World(staticCount, seed: 21, largest: 10));
        active.Tree.BinnedBuild(active.Pool);
        var pieces = new OverlapPieces(active.Tree, still.Tree, 8 * workerCount, workerCount, active.Pool);
        try
        {
            Assert.True(pieces.Pairs.Count > workerCount);
            var order = Enumerable.Range(0, pieces.Order.Count).Select(i => pieces.Order[i]).ToArray();
            Assert.Equal(Enumerable.Range(-pieces.RangeCount, pieces.RangeCount + pieces.Pairs.Count), order.Order());

            // Ranges are in order. Between them are the pairs of the part that begins with the next one.
            Assert.Equal(Enumerable.Range(0, pieces.RangeCount), order.Where(piece => piece < 0).Select(piece => ~piece));
            var node = 0;
            foreach (var piece in order)
            {
                if (piece < 0)
                    pieces.GetRange(~piece, out _, out node);
                else
                    Assert.InRange(PlaceOf(pieces.Pairs[piece], active), node, node + (active.Tree.NodeCount + workerCount - 1) / workerCount);
            }
        }
        finally
        {
            pieces.Dispose(active.Pool);
        }
    }

    static unsafe int PlaceOf(in OverlapPieces.Pair pair, TreeModel model)
    {
        var larger = pair.IsStatic || pair.Children.A->LeafCount >= pair.Children.B->LeafCount ? pair.Children.A : pair.Children.B;
        return larger->Index >= 0 ? larger->Index : (int)(larger - model.Tree.Children) / 2;
    }
}
